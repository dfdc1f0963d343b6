// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <sys/types.h>

#include <functional>
#include <optional>

#include "vitrine/export.hpp"

namespace vitrine::accuracy {

/// A forked process that sends bytes back. It sees what this process had in memory, and may crash without harm.
struct Child {
  pid_t pid = -1;
  int pipe = -1;  ///< to be read from; -1 once it has ended
  Bytes sent;
  bool fine = false;   ///< ended by itself, everything was sent
  double peak_mb = 0;  ///< most memory it held, what it shares with this process included
};

/// Starts `work` in a process of its own. None when the machine has no room for one.
std::optional<Child> start(const std::function<Bytes()>& work);
/// Reads what is there, and no more; at its end waits for the process. True when it has ended.
bool listen(Child& child);
/// Waits for all of it.
void finish(Child& child);

}  // namespace vitrine::accuracy
