// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

// A skirt whose corners all turn inwards: its own picture is not one.
BROKEN_GARMENT(Skirt, for (auto& feature : t.features) feature.turn = VITRINE_TURN_CONCAVE);
