// SPDX-License-Identifier: GPL-3.0-or-later
// expects: name.known: the landmark of a feature is none that a body has
// expects: ankel_right
#include "garment.hpp"

constexpr auto table = changed(templates::skirt_features, [](auto& rows) { rows[2].landmark = "ankel_right"; });
constexpr auto garment = changed(templates::skirt, [](auto& g) { g.features = sdk::span(table); });
VITRINE_CHECK(garment);
