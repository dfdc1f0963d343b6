// SPDX-License-Identifier: GPL-3.0-or-later
#define vitrine_plugin_entry declared_constant
#include "sound.hpp"
#undef vitrine_plugin_entry

namespace {

vitrine_neckline necklines[1] = {vitrine::templates::neck_v};

}  // namespace

extern "C" {
VITRINE_EXPORT vitrine_plugin vitrine_plugin_entry = sound::with(vitrine::sdk::span(sound::necklines));
}

// Tables have to lie in the library's own image.
AT_LOAD {
  vitrine_plugin_entry.necklines.data = new vitrine_neckline(necklines[0]);
}
