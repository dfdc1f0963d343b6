// SPDX-License-Identifier: GPL-3.0-or-later
#include "estimate.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace vitrine::sewing {

double surface_change(const Pattern& pattern, const Positions& before, const Positions& now) {
  double sum = 0, area = 0;
  for (std::size_t p = 0; p < pattern.meshes.size(); ++p)
    for (const Triangle& t : pattern.meshes[p].triangles) {
      const Vec3 &a = now[p][t[0]], &b = now[p][t[1]], &c = now[p][t[2]];
      const Vec3 twice = (b - a).cross(c - a);  // twice the area, along the normal
      const double length = twice.norm();
      if (!(length > 0)) continue;
      for (const auto n : t) sum += std::abs((now[p][n] - before[p][n]).dot(twice)) / 3;
      area += length;
    }
  return area > 0 ? sum / area : 0;
}

double loose_share(const Pattern& pattern, const Positions& positions, const DistanceField& body, double offset) {
  double loose = 0, all = 0;
  for (std::size_t p = 0; p < pattern.meshes.size(); ++p)
    for (const Vec3& x : positions[p]) loose += body.distance(x) > offset + 0.01, ++all;
  return all > 0 ? loose / all : 0;
}

double estimate_error(std::span<const LevelFigures> levels) {
  const LevelFigures& last = levels.back();
  if (levels.size() < 2) return 0.2 * last.edge_mm;
  const double ratio = levels[levels.size() - 2].edge_mm / last.edge_mm;
  return ratio > 1.05 ? last.change_surface_mm / (ratio - 1) : 0.2 * last.edge_mm;
}

}  // namespace vitrine::sewing
