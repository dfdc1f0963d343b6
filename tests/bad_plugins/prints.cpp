// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>

#include "sound.hpp"

AT_LOAD {
  std::puts("Thank you for choosing us");
}

SOUND_NECKLINE();
