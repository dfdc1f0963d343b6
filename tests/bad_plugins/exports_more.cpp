// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

extern "C" VITRINE_EXPORT const int another_symbol = 1;

SOUND_NECKLINE();
