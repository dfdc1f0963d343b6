// SPDX-License-Identifier: GPL-3.0-or-later
#include <cfenv>

#include "sound.hpp"

AT_LOAD {
  std::fesetround(FE_DOWNWARD);
}

SOUND_NECKLINE();
