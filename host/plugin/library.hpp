// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "vitrine/model/result.hpp"

namespace vitrine {

/// Loads a shared library for ever and returns its plugin descriptor, not yet looked at.
/// Errors (69): PLUGIN_FILE_LOAD (not a library, or one with undefined symbols), PLUGIN_FILE_ENTRY (no descriptor).
Result<const void*> load_entry(const std::filesystem::path& absolute_file);

}  // namespace vitrine
