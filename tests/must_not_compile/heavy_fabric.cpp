// SPDX-License-Identifier: GPL-3.0-or-later
// expects: number.range: stretch is 1 to 1e7 N/m
// expects: denim
#include "garment.hpp"

constexpr auto table = changed(templates::skirt_fabrics, [](auto& rows) { rows[1].mass = 400; });
constexpr auto garment = changed(templates::skirt, [](auto& g) { g.fabrics = sdk::span(table); });
VITRINE_CHECK(garment);
