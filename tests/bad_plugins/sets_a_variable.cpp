// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>

#include "sound.hpp"

AT_LOAD {
  setenv("LANG", "C", 1);
  setenv("EXAMPLE_PLUGIN", "1", 1);
}

SOUND_NECKLINE();
