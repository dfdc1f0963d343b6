// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

BROKEN_GARMENT(Vest, t.pose[0].radius = t.pose[1].radius = 0.5);
