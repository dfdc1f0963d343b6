// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

BROKEN_GARMENT(Skirt, t.anchors[0].name = "hem_left", t.anchors[1].name = "hem_right");
