// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>

#include "sound.hpp"

AT_LOAD {
  throw std::runtime_error("no");
}

SOUND_NECKLINE();
