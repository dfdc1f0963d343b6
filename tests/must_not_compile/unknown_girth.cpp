// SPDX-License-Identifier: GPL-3.0-or-later
// expects: name.known: the scale rule names a girth that no body has
// expects: waste
#include "garment.hpp"

constexpr auto scale = changed(templates::skirt_scale, [](auto& rule) { rule.girth = "waste"; });
constexpr auto garment = changed(templates::skirt, [](auto& g) { g.scale = sdk::span_one(scale); });
VITRINE_CHECK(garment);
