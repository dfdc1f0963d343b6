// SPDX-License-Identifier: GPL-3.0-or-later
// expects: mirror.involution: a feature has to be the mirror of its mirror
// expects: waist_left
#include "garment.hpp"

constexpr auto table = changed(templates::skirt_features, [](auto& rows) { rows[0].mirror = "hem_left"; });
constexpr auto garment = changed(templates::skirt, [](auto& g) { g.features = sdk::span(table); });
VITRINE_CHECK(garment);
