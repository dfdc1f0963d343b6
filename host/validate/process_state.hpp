// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace vitrine::validation {

/// What a library could have changed about its process when it was loaded.
struct ProcessState {
  int threads = 0;
  int children = 0;
  std::vector<std::string> open_files;   ///< "5 -> /path", sorted
  std::vector<std::string> environment;  ///< sorted
  std::string folder, locale;
  unsigned mode_mask = 0;
  std::vector<std::uintptr_t> handlers;  ///< of signals, then terminate and new handlers
  std::vector<bool> blocked;             ///< signals
  bool timer = false;                    ///< an interval timer or alarm runs
  int rounding = 0;
  std::uint32_t sse_control = 0;  ///< without the sticky exception flags
  std::uint16_t x87_control = 0;
  std::uint64_t address_space = 0;  ///< [byte]
  double cpu_seconds = 0;           ///< [s] of this process

  static ProcessState now();
};

/// A stretch of memory as /proc/self/maps lists it.
struct Mapping {
  std::uintptr_t begin = 0, end = 0;
  bool writable = false;
  std::string file;
};
std::vector<Mapping> mappings();

/// Sends what is printed into memory while it lives.
class OutputTrap {
 public:
  OutputTrap();
  ~OutputTrap();
  OutputTrap(const OutputTrap&) = delete;
  OutputTrap& operator=(const OutputTrap&) = delete;
  /// The first bytes that were printed so far.
  std::string printed() const;

 private:
  int memory_ = -1;
};

}  // namespace vitrine::validation
