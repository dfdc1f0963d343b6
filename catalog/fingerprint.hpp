// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace vitrine {

std::string sha256_of(std::string_view text);  ///< [hex]
/// [hex] of a file's content; empty when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);

/// What changes with every write to a file. Where it is the same, so is the content.
struct FileStamp {
  std::int64_t size = -1, modified = 0, changed = 0;  ///< [byte], [ns], [ns]
  std::uint64_t inode = 0;
  bool operator==(const FileStamp&) const = default;
};
std::optional<FileStamp> stamp_of(const std::filesystem::path& file);  ///< empty when there is no regular file

struct Fingerprint {
  std::string sha256;  ///< [hex], or why there is none: "missing"
  /// Empty when the file was so young when it was read that a later write could have left the same stamp.
  std::optional<FileStamp> stamp;
  bool operator==(const Fingerprint&) const = default;
};
using Fingerprints = std::map<std::string, Fingerprint>;  ///< by name

/// Reads the file, or takes `known` where its stamp still fits and `checksum` is off.
Fingerprint fingerprint(const std::filesystem::path& file, const Fingerprint* known, bool checksum);
/// The same for a file that nobody else writes: its stamp is trusted at once.
Fingerprint own_fingerprint(const std::filesystem::path& file);

nlohmann::json to_json(const Fingerprints& files);
/// Without the stamps when not `trusted`. False when the JSON is none of these.
bool from_json(const nlohmann::json& json, bool trusted, Fingerprints& files);

}  // namespace vitrine
