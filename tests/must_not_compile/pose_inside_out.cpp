// SPDX-License-Identifier: GPL-3.0-or-later
// expects: pose.clockwise: the outline of a pose has to run clockwise in the picture
// expects: flared
#include "garment.hpp"

constexpr auto points = changed(templates::skirt_flared, [](auto& rows) {
  for (auto& point : rows) point.u = 1 - point.u;
});
constexpr auto table = changed(templates::skirt_poses, [](auto& rows) { rows[1].points = sdk::span(points); });
constexpr auto garment = changed(templates::skirt, [](auto& g) { g.poses = sdk::span(table); });
VITRINE_CHECK(garment);
