// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "vitrine/model/result.hpp"

namespace vitrine {

/// A plugin file that was opened and trusted. What is hashed, looked at and loaded is the open file, not its path: a
/// file that is put in its place afterwards changes nothing.
struct PluginFile {
  std::filesystem::path path;         ///< symbolic links resolved
  std::shared_ptr<const int> handle;  ///< file descriptor, closed with the last copy
  std::vector<std::uint8_t> bytes;    ///< at most max_plugin_bytes
  std::string sha256;                 ///< [hex] of the bytes
};

/// A plugin holds tables; the largest that ships has a fiftieth of this.
inline constexpr std::uint64_t max_plugin_bytes = 16u << 20;

/// Opens the file that a path means, if nobody but root and the user can change it: file and folder belong to one of
/// the two and are not writable for others, and no folder above lets others swap what is in it (a folder like /tmp,
/// where only owners may rename, does not).
/// Errors (69): PLUGIN_FILE_NAME, PLUGIN_FILE_MISSING, PLUGIN_FILE_KIND, PLUGIN_FILE_TRUST, PLUGIN_FILE_SIZE.
Result<PluginFile> open_plugin_file(const std::filesystem::path& file);

/// The *.vitrine.so entries of a folder in byte order of their names, not yet resolved or trusted; the folder itself
/// is. Errors (69): PLUGIN_FOLDER_MISSING, PLUGIN_FILE_TRUST.
Result<std::vector<std::filesystem::path>> plugin_files_in(const std::filesystem::path& folder);

}  // namespace vitrine
