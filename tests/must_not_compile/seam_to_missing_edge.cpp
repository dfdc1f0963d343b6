// SPDX-License-Identifier: GPL-3.0-or-later
// expects: name.known: a seam sews an edge that this garment does not have
// expects: pocket
#include "garment.hpp"

constexpr auto table = changed(templates::skirt_seams, [](auto& rows) { rows[1].edge_b = "pocket"; });
constexpr auto garment = changed(templates::skirt, [](auto& g) { g.seams = sdk::span(table); });
VITRINE_CHECK(garment);
