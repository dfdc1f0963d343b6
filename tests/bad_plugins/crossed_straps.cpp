// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

BROKEN_GARMENT(Vest, t.pose[2].u = 0.6, t.pose[2].v = 0, t.pose[7].u = 0.4, t.pose[7].v = 0);
