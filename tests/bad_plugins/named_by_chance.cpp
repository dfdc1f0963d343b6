// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <cstdio>

#define vitrine_plugin_entry declared_constant
#include "sound.hpp"
#undef vitrine_plugin_entry

namespace {

char title[32] = "Skirt";
vitrine_garment garments[1];

}  // namespace

extern "C" {
VITRINE_EXPORT vitrine_plugin vitrine_plugin_entry = sound::entry;
}

// Tables that are made when the library is loaded, and not the same in two processes.
AT_LOAD {
  std::snprintf(title, sizeof title, "Skirt %d", static_cast<int>(getpid()));
  garments[0] = sound::garments[0];
  garments[0].title = title;
  vitrine_plugin_entry.garments.data = garments;
}
