// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

// Twenty megabytes of nothing.
[[gnu::used]] static char space[20u << 20];

SOUND_NECKLINE();
