// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

BROKEN_GARMENT(Skirt, t.fabrics[0].mass = std::numeric_limits<double>::quiet_NaN());
