// SPDX-License-Identifier: GPL-3.0-or-later
#include "estimate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace vitrine::sewing {
namespace {

// Found on items of which none is measured for docs/ACCURACY.md: those of benchmarks/accuracy/estimate.csv, which
// `vitrine-estimate-bench` wrote (docs/ARCHITECTURE.md).
constexpr double turn_mm = 20;  // [mm / rad] that folds lie off the mark, by how sharply the mesh turns in them
// [-] of the edge length that cloth is off everywhere: folds and roundness that are too small for the mesh
constexpr double edge_share = 0.05;
// [mm] off the body, from where on whole folds of a flared skirt lie somewhere else
constexpr double far_mm = 50;

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

double loose_turn(const Pattern& pattern, const Positions& x, const DistanceField& body, double offset) {
  struct Side {
    std::uint32_t from, to;
    Vec3 twice;  // the triangle's area, twice, along its normal
  };
  double sum = 0, area = 0;
  for (std::size_t p = 0; p < pattern.meshes.size(); ++p) {
    std::vector<Side> sides;
    for (const Triangle& t : pattern.meshes[p].triangles) {
      const Vec3& a = x[p][t[0]];
      const Vec3 twice = (x[p][t[1]] - a).cross(x[p][t[2]] - a);
      for (int e = 0; e < 3; ++e) {
        const auto [from, to] = std::minmax(t[e], t[(e + 1) % 3]);
        sides.push_back({from, to, twice});
      }
    }
    // The two sides of an edge come next to each other; which is first makes no difference.
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return a.from != b.from ? a.from < b.from : a.to < b.to; });
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
      const Side &a = sides[i], &b = sides[i + 1];
      if (a.from != b.from || a.to != b.to) continue;
      const double weight = a.twice.norm() + b.twice.norm();
      area += weight;
      if (body.distance((x[p][a.from] + x[p][a.to]) / 2) > offset + 0.01)
        sum += weight *
               (a.twice.normalized() - b.twice.normalized()).norm();  // as an angle; no library's arc decides the bytes
    }
  }
  return area > 0 ? sum / area : 0;
}

double mean_gap(const Pattern& pattern, const Positions& x, const DistanceField& body, double offset) {
  double sum = 0, area = 0;
  for (std::size_t p = 0; p < pattern.meshes.size(); ++p)
    for (const Triangle& t : pattern.meshes[p].triangles) {
      const Vec3 &a = x[p][t[0]], &b = x[p][t[1]], &c = x[p][t[2]];
      const double weight = (b - a).cross(c - a).norm();
      area += weight;
      sum += weight * std::max(0.0, body.distance((a + b + c) / 3) - offset);
    }
  return area > 0 ? sum / area : 0;
}

double estimate_error(const LevelFigures& level) {
  const double far = level.gap_mm / far_mm;
  return (turn_mm * level.loose_turn + edge_share * level.edge_mm) * (1 + far * far);
}

}  // namespace vitrine::sewing
