// SPDX-License-Identifier: GPL-3.0-or-later
// The control: nothing is changed, so it compiles.
#include "garment.hpp"
#include "vitrine/templates/necklines.hpp"

constexpr auto garment = changed(templates::skirt, [](auto&) {});
VITRINE_CHECK(garment);
VITRINE_CHECK(templates::neck_v);
static_assert(sdk::check(garment) && sdk::broken_rule(garment).length == 0);
