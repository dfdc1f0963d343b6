// SPDX-License-Identifier: GPL-3.0-or-later
// expects: name.known: an anchor is a feature that this garment does not have
// expects: belt
#include "garment.hpp"

constexpr auto table = changed(templates::skirt_anchors, [](auto& rows) { rows[0].name = "belt"; });
constexpr auto garment = changed(templates::skirt, [](auto& g) { g.anchors = sdk::span(table); });
VITRINE_CHECK(garment);
