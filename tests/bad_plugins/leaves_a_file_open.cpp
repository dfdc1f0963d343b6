// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>

#include <cstdlib>

#include "sound.hpp"

AT_LOAD {
  if (open("/dev/null", O_RDONLY) < 0) std::abort();
}

SOUND_NECKLINE();
