// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "vitrine/model/result.hpp"

namespace vitrine {

class PluginRegistry;

/// One line of a plugins.lock: exactly this file may be loaded.
struct LockedPlugin {
  std::string id, version;
  std::string sha256;  ///< [hex] of the file
};

/// plugins.lock: a first line that names the format, then "SHA256  ID  VERSION", sorted by id. Lines that are empty or
/// begin with # are comments.
std::string lock_text(const PluginRegistry& registry);

/// Errors: MISSING (66); PLUGIN_LOCK_FORM (69) naming the line.
Result<std::vector<LockedPlugin>> read_lock(const std::filesystem::path& file);

}  // namespace vitrine
