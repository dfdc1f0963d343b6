// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "vitrine/model/geometry.hpp"

namespace vitrine::body {

/// Corners of the convex hull, counter-clockwise.
std::vector<Vec2> convex_hull(std::vector<Vec2> points);

/// What a tape around the points reads [m].
double hull_perimeter(const std::vector<Vec2>& points);

}  // namespace vitrine::body
