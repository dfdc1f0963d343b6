// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

BROKEN_GARMENT(Skirt, t.features[2].landmark = "knee_left", t.features[3].landmark = "knee_right");
