// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <vector>

#include "vitrine/host/search.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

/// Addresses [begin, end) that can be read.
struct MemoryRange {
  std::uintptr_t begin = 0, end = 0;
  bool holds(std::uintptr_t at, std::size_t size) const { return at >= begin && at <= end && size <= end - at; }
};

/// A library in memory.
struct LoadedPlugin {
  const void* entry = nullptr;     ///< the descriptor, not yet looked at
  std::vector<MemoryRange> image;  ///< the library's own segments; everything that a plugin points to lies in them
};

/// Loads a shared library for ever. This runs its static constructors.
/// Errors (69): PLUGIN_FILE_LOAD (not a library, or one with undefined symbols), PLUGIN_FILE_ENTRY (no descriptor).
Result<LoadedPlugin> load_library(const PluginFile& file);

}  // namespace vitrine
