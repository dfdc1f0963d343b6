// SPDX-License-Identifier: GPL-3.0-or-later
// expects: name.unique: no two rows of a table have the same name
// expects: hem_right
#include "garment.hpp"

constexpr auto table = changed(templates::skirt_features, [](auto& rows) { rows[3].name = "hem_right"; });
constexpr auto garment = changed(templates::skirt, [](auto& g) { g.features = sdk::span(table); });
VITRINE_CHECK(garment);
