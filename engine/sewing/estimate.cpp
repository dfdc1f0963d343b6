// SPDX-License-Identifier: GPL-3.0-or-later
#include "estimate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace vitrine::sewing {
namespace {

// Chosen on the items of benchmarks/accuracy/estimate.csv, which `vitrine-estimate-bench` wrote; rather too large than
// too small (docs/ARCHITECTURE.md).
constexpr double tight_share = 0.02, loose_more = 0.19;  // [-] of the edge length: cloth that is held, and that hangs
constexpr double free_more = 0.7;                        // [-] the same where next to nothing holds it: a flared skirt
// [-] of what the second level moved, and a later one, still to come where it halved the edges.
constexpr double second_share = 0.8, later_share = 0.65;

}  // namespace

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
  // One level alone: sagging chords and missing folds grow with the edges, where the body does not hold the cloth.
  if (levels.size() < 2) {
    const double loose = last.loose_share;
    return last.edge_mm * (tight_share + loose_more * loose + free_more * std::pow(loose, 12));
  }
  // The closer two levels are, the less of what is to come has one of them shown.
  const double finer = levels[levels.size() - 2].edge_mm / last.edge_mm - 1;
  const double share = levels.size() == 2 ? second_share : later_share;
  return last.change_surface_mm * share / std::sqrt(std::max(finer, 0.05));
}

}  // namespace vitrine::sewing
