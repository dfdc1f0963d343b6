// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

BROKEN_GARMENT(Skirt, t.features[0].mirror = "waist_right", t.features[1].mirror = "hem_right",
               t.features[2].mirror = "waist_left");
