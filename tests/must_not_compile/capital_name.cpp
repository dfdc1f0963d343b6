// SPDX-License-Identifier: GPL-3.0-or-later
// expects: name.form: a name is small letters, digits and _
// expects: Hem
#include "garment.hpp"

constexpr auto table = changed(templates::skirt_edges, [](auto& rows) { rows[2].name = "Hem"; });
constexpr auto garment = changed(templates::skirt, [](auto& g) { g.edges = sdk::span(table); });
VITRINE_CHECK(garment);
