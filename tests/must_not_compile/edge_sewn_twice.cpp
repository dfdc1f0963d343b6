// SPDX-License-Identifier: GPL-3.0-or-later
// expects: seam.pairs: an edge of kind SEAM has to be sewn exactly once on the front and once on the back
// expects: side_right
#include "garment.hpp"

constexpr auto table = changed(templates::skirt_seams, [](auto& rows) { rows[1] = rows[0]; });
constexpr auto garment = changed(templates::skirt, [](auto& g) { g.seams = sdk::span(table); });
VITRINE_CHECK(garment);
