// SPDX-License-Identifier: GPL-3.0-or-later
// expects: name.known: an edge begins or ends at a feature that this garment does not have
// expects: side_right
#include "garment.hpp"

constexpr auto table = changed(templates::skirt_edges, [](auto& rows) { rows[1].to = "pocket"; });
constexpr auto garment = changed(templates::skirt, [](auto& g) { g.edges = sdk::span(table); });
VITRINE_CHECK(garment);
