// SPDX-License-Identifier: GPL-3.0-or-later
// expects: outline.neck: a garment has at most one neck edge
// expects: hem
#include "garment.hpp"

constexpr auto table =
    changed(templates::skirt_edges, [](auto& rows) { rows[0].kind = rows[2].kind = VITRINE_EDGE_NECK; });
constexpr auto garment = changed(templates::skirt, [](auto& g) { g.edges = sdk::span(table); });
VITRINE_CHECK(garment);
