// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <functional>
#include <string>

namespace vitrine {

/// How a child process ended.
struct ChildEnd {
  enum class How {
    finished,    ///< its function returned
    crashed,     ///< by a signal
    exited,      ///< somebody in it called exit()
    timed_out,   ///< nothing was heard of it for too long; it was killed
    not_started  ///< fork() failed
  };
  How how = How::not_started;
  int number = 0;  ///< signal or exit code
  /// "it crashed (signal 11, Segmentation fault)", "it ended the process with exit code 3", ...
  std::string text() const;
};

/// The child's end of the pipe.
class ChildReport {
 public:
  explicit ChildReport(int fd) : fd_(fd) {}
  /// One record, of any bytes. Records arrive in order; what was sent before a crash arrives.
  void send(const std::string& record) const;

 private:
  int fd_;
};

struct ChildLimits {
  double silent_seconds = 10;     ///< [s] the longest time between two records
  std::uint64_t cpu_seconds = 0;  ///< [s] of processor, for a child that loops; 0 = no limit
};

/// Forks, runs `work` in the child, and hands each record to `receive`, in this process. The child sees the memory as
/// it is now and changes none of it; it dies with this process, and what it started dies with it. A child process stops
/// accidents, not malice: code in it has the user's rights.
ChildEnd run_in_child(const ChildLimits& limits, const std::function<void(const ChildReport&)>& work,
                      const std::function<void(const std::string&)>& receive);

}  // namespace vitrine
