// SPDX-License-Identifier: GPL-3.0-or-later
// expects: seam.kind: a seam sews edges of kind SEAM only
// expects: hem
#include "garment.hpp"

constexpr auto table = changed(templates::skirt_seams, [](auto& rows) { rows[1].edge_b = "hem"; });
constexpr auto garment = changed(templates::skirt, [](auto& g) { g.seams = sdk::span(table); });
VITRINE_CHECK(garment);
