// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "vitrine/model/geometry.hpp"

namespace vitrine::bench {

struct Surface {
  std::vector<Vec3> points;  ///< [m]
  std::vector<Triangle> triangles;
};

struct SurfaceDistance {
  double mean = 0, p95 = 0, most = 0;  ///< [m]
};

/// Closest distances between two surfaces, from points spread evenly over each to the other; both ways count alike.
SurfaceDistance surface_distance(const Surface& a, const Surface& b);

}  // namespace vitrine::bench
