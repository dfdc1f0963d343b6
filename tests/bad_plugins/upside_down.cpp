// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

BROKEN_GARMENT(Skirt, t.scale.top = "hem_left", t.scale.bottom = "waist_left");
