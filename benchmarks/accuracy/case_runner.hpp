// SPDX-License-Identifier: GPL-3.0-or-later
// One case of a suite, in a process of its own: a crash, a hang or hunger for memory ends the case, not the suite.
#pragma once
#include <functional>
#include <optional>
#include <string>

namespace vitrine::bench {

/// What became of a case.
struct Outcome {
  std::string status;  ///< a drape's status, an error's code, "OK"; filled in below otherwise
  std::optional<double> residual, gap_mm, penetration_mm, stretch_p99;
  bool finite = true;  ///< every position, or there is nothing to be finite
  std::string note;
  double cpu_ms = 0;     ///< of the case alone, without what was ready before it
  bool refused = false;  ///< `status` is an error's code, not a drape's

  /// A result that can be believed, a result whose status says what is wrong with it, or a refusal with a code.
  bool as_it_should_be() const;
};

/// Runs `body` in a child process with so many seconds of processor and megabytes of address space. A child that dies
/// has the status CRASH, CPU_LIMIT or NO_ANSWER.
Outcome run_apart(const std::function<Outcome()>& body, int cpu_seconds, int megabytes);

/// One row of extremes.csv.
std::string csv_row(const std::string& group, const std::string& name, const Outcome& outcome);
inline constexpr const char* csv_head =
    "group,case,status_or_code,residual,gap_mm,penetration_mm,stretch_p99,finite,cpu_ms,note\n";

}  // namespace vitrine::bench
