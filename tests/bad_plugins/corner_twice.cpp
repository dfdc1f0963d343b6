// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

BROKEN_GARMENT(Vest, t.edges[4].to = "shoulder_left", t.edges[5].from = "shoulder_left", t.edges[5].to = "armpit_left");
