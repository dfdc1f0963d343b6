// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

// A shoulder sewn to a side.
BROKEN_GARMENT(Vest, t.seams[1].edge_b = "shoulder_seam_right", t.seams[0].edge_b = "side_right", t.pose[2].u = 0.77,
               t.pose[7].u = 0.23, t.seams[0].reversed = t.seams[1].reversed = 1);
