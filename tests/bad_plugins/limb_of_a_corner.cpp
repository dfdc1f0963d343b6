// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

BROKEN_GARMENT(Sleeves, t.limbs[0].root_b = t.limbs[0].root_a);
