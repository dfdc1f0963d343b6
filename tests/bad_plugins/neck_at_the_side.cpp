// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

BROKEN_GARMENT(Vest, t.edges[0].kind = VITRINE_EDGE_OPEN, t.edges[2].kind = VITRINE_EDGE_NECK);
