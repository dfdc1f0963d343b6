// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include "sound.hpp"

AT_LOAD {
  for (;;) pause();
}

SOUND_NECKLINE();
