// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

BROKEN_GARMENT(Skirt, t.features[2].landmark = "ankle_right");
