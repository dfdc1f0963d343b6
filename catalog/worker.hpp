// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <sys/resource.h>
#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>

#include "fingerprint.hpp"
#include "vitrine/run_catalog.hpp"

namespace vitrine {

/// How a worker ended.
struct WorkerEnd {
  int signal = 0;                      ///< that ended it, or 0
  std::optional<ItemOutcome> outcome;  ///< empty when it gave none
  Fingerprints files;                  ///< that it left, by path in its folder
  double cpu_seconds = 0, wall_seconds = 0;
  long peak_kilobytes = 0;  ///< of resident memory, what it shares with the parent included
};

/// One forked process that converts one item and sends the outcome through a pipe.
class Worker {
 public:
  using Clock = std::chrono::steady_clock;

  /// Forks. Empty when the system has no process or pipe left.
  static std::optional<Worker> start(const CatalogItem& item, const std::string& folder, const CatalogOptions& options,
                                     const ItemFunction& convert);
  Worker(Worker&& other) noexcept;
  Worker& operator=(Worker&& other) noexcept;
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker();  ///< kills the process if it still runs

  /// Takes in what has arrived. True once the process has ended and been collected.
  bool poll();
  /// Kills the process and what it started, and waits for it.
  void kill();
  int pipe() const { return pipe_; }  ///< to wait on; -1 once the worker has closed its end
  bool late() const { return Clock::now() >= deadline_; }
  Clock::time_point deadline() const { return deadline_; }
  WorkerEnd end() const;

  std::size_t index = 0;  ///< of the item
  bool timed_out = false;

 private:
  Worker() = default;
  void drain();
  pid_t pid_ = -1;
  int pipe_ = -1;
  int status_ = 0;
  Clock::time_point start_, deadline_, end_;
  struct rusage usage_ = {};
  std::string received_;
};

}  // namespace vitrine
