// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

// Believable in every number, but heavier than it can carry.
BROKEN_GARMENT(Skirt, t.fabrics[1].stretch = 10, t.fabrics[1].shear = 2, t.fabrics[1].mass = 1.5);
