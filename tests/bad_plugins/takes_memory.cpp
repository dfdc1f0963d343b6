// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/mman.h>

#include <cstdlib>

#include "sound.hpp"

// A hundred megabytes of address space, not touched.
AT_LOAD {
  if (mmap(nullptr, 100u << 20, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED) std::abort();
}

SOUND_NECKLINE();
