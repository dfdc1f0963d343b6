// SPDX-License-Identifier: GPL-3.0-or-later
// expects: outline.order: the edges have to visit the features once
// expects: waist
#include "garment.hpp"

constexpr auto table = changed(templates::skirt_features, [](auto& rows) { std::swap(rows[0], rows[1]); });
constexpr auto garment = changed(templates::skirt, [](auto& g) { g.features = sdk::span(table); });
VITRINE_CHECK(garment);
