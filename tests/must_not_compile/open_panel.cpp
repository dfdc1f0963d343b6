// SPDX-License-Identifier: GPL-3.0-or-later
// expects: outline.closed: the panel is open: each edge has to begin where the one before it ends
// expects: side_left
#include "garment.hpp"

constexpr auto table = changed(templates::skirt_edges, [](auto& rows) { rows[3].to = "waist_right"; });
constexpr auto garment = changed(templates::skirt, [](auto& g) { g.edges = sdk::span(table); });
VITRINE_CHECK(garment);
