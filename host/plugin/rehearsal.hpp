// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "vitrine/host/search.hpp"

namespace vitrine {

/// Loads and adopts the files in a child process, in this order, as the host is about to: static constructors run at
/// load, before any check, and may end the process. Per file: why it must not be loaded, or nothing. One child does for
/// all as long as none of them ends it; a file that does is left out, and the others go on in another.
/// Errors (69): PLUGIN_FILE_CRASH, PLUGIN_FILE_EXIT, PLUGIN_FILE_HANG.
std::vector<std::optional<Error>> rehearse(const std::vector<PluginFile>& files, double seconds_each);

}  // namespace vitrine
