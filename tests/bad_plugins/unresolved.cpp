// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

// Its data is sound; the function it names but never defines would end the process at the call if it were loaded
// lazily.
extern "C" const void* defined_nowhere(const char* id);

namespace {

const void* extension(const char* id) {
  return defined_nowhere(id);
}

}  // namespace

BROKEN_ENTRY(p.extension = extension);
