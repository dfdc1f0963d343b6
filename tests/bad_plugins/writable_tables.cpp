// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

namespace {

// Not const: whoever has a pointer can change it.
vitrine_neckline writable[] = {vitrine::templates::neck_v};

}  // namespace

constinit const vitrine_plugin vitrine_plugin_entry = sound::with(vitrine::sdk::span(writable));
