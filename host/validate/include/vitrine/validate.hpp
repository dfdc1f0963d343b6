// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vitrine/host/registry.hpp"
#include "vitrine/pipeline.hpp"

namespace vitrine {

/// A named check of a plugin file.
struct CheckInfo {
  std::string_view name;         ///< e.g. "outline.closed"
  int level = 1;                 ///< 1 load, 2 descriptor, 3 template, 4 pipeline, 5 determinism, 6 hardening
  std::string_view description;  ///< one sentence: what a plugin that passes keeps
};
/// All checks, by level; within a level in the order in which reports list them.
std::span<const CheckInfo> plugin_checks();
constexpr int max_check_level = 6;
std::string_view level_name(int level);

enum class CheckStatus { passed, failed, skipped };

struct CheckResult {
  std::string name;
  int level = 1;
  CheckStatus status = CheckStatus::skipped;
  std::string message;  ///< why it failed or was skipped; figures of a passed one, or empty
};

/// What was found out about one file.
struct FileReport {
  std::string file;
  std::string id, version, sha256;  ///< empty where the file was not got that far
  std::vector<std::string> garments, necklines;
  std::vector<CheckResult> checks;  ///< one per check asked for
};

struct ValidateOptions {
  int level = 4;          ///< the highest level that is checked
  std::string only;       ///< name or beginning of a name ("hardening"): report these checks only; empty = all
  unsigned seed = 0;      ///< of the photos drawn: 0 = as the template says, else corners and colours vary a little
  double seconds = 120;   ///< [s] the longest that one check may take
  PluginSearch partners;  ///< necklines for garments and garments for necklines
  std::vector<std::string> photos;   ///< front photos of the garment itself, to be converted besides the drawn ones
  std::string keep;                  ///< folder in which the drawn photos are kept; empty = they are not
  std::shared_ptr<const Body> body;  ///< needed from level 4 on
  std::string program;  ///< of this vitrine, for the check in another process; empty = that check is skipped
};

struct Validation {
  std::vector<FileReport> files;
  int passed = 0, failed = 0, skipped = 0;
  /// Nothing failed, and something passed: no check at all is no success.
  bool ok() const { return failed == 0 && passed > 0; }
};

/// Checks each file in a child process of its own. A child that ends before it has reported fails the check it was in,
/// as does one that hangs.
/// Errors (64): UNKNOWN_CHECK.
Result<Validation> validate_plugins(const std::vector<std::string>& files, const ValidateOptions& options);

/// Failed checks with their reasons, skipped ones when `all`, then "N passed, N failed, N skipped".
std::string validation_text(const Validation& validation, bool all);
/// The same for programs. Holds nothing that differs from run to run.
std::string validation_json(const Validation& validation, const ValidateOptions& options, const std::string& version);

/// What another process is asked for: SHA-256 [hex] of the tables as read and of the files of a draft conversion.
/// `garment` may be empty: the tables only.
struct DigestRequest {
  std::string file;  ///< plugin
  PluginSearch partners;
  std::string garment, neckline, front, back;
};
Result<std::string> conversion_digest(const DigestRequest& request, const std::shared_ptr<const Body>& body);

}  // namespace vitrine
