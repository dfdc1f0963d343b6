// SPDX-License-Identifier: GPL-3.0-or-later
// expects: pose.complete: a pose has to place every feature exactly once
// expects: hem_right
#include "garment.hpp"

constexpr auto points = changed(templates::skirt_flared, [](auto& rows) { rows[3] = rows[2]; });
constexpr auto table = changed(templates::skirt_poses, [](auto& rows) { rows[1].points = sdk::span(points); });
constexpr auto garment = changed(templates::skirt, [](auto& g) { g.poses = sdk::span(table); });
VITRINE_CHECK(garment);
