// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The plugin that the broken ones start from.
#include "vitrine/plugin.hpp"
#include "vitrine/templates/skirt.hpp"

namespace sound {

inline constexpr std::array garments = {vitrine::templates::skirt};
inline constexpr vitrine_plugin entry = {.magic = VITRINE_MAGIC,
                                         .abi_major = VITRINE_ABI_MAJOR,
                                         .abi_minor = VITRINE_ABI_TARGET_MINOR,
                                         .size = sizeof(vitrine_plugin),
                                         .vendor = "Example",
                                         .id = "org.example.sound",
                                         .version = "1.0.0",
                                         .garments = vitrine::sdk::span(garments),
                                         .necklines = {},
                                         .extension = nullptr};

}  // namespace sound

/// The sound plugin after one change: `p` in the expression is the descriptor.
#define BROKEN_ENTRY(change)                                 \
  constinit const vitrine_plugin vitrine_plugin_entry = [] { \
    vitrine_plugin p = sound::entry;                         \
    change;                                                  \
    return p;                                                \
  }()
