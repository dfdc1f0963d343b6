// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

BROKEN_GARMENT(Vest, t.edges[4].kind = VITRINE_EDGE_NECK);
