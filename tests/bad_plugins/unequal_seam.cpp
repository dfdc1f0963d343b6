// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

// Half of one side is sewn to the other whole side: a fifth of its length.
BROKEN_GARMENT(Vest, t.seams[1].edge_b = "shoulder_seam_right", t.seams[0].edge_b = "side_right", t.seams[0].reversed = t.seams[1].reversed = 1);
