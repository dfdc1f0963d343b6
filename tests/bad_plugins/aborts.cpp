// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>

#include "sound.hpp"

AT_LOAD {
  std::abort();
}

SOUND_NECKLINE();
