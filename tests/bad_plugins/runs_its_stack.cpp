// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

SOUND_NECKLINE();
