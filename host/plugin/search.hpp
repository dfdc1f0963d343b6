// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <vector>

#include "vitrine/model/result.hpp"

namespace vitrine {

/// The file that a path means (symbolic links resolved), if nobody but root and the user can change it.
/// Errors (69): PLUGIN_FILE_NAME, PLUGIN_FILE_MISSING, PLUGIN_FILE_KIND, PLUGIN_FILE_TRUST.
Result<std::filesystem::path> trusted_plugin_file(const std::filesystem::path& file);

/// The *.vitrine.so entries of a folder in byte order of their names, not yet resolved or trusted; the folder itself
/// is. Errors (69): PLUGIN_FOLDER_MISSING, PLUGIN_FILE_TRUST.
Result<std::vector<std::filesystem::path>> plugin_files_in(const std::filesystem::path& folder);

}  // namespace vitrine
