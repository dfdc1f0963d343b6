// SPDX-License-Identifier: GPL-3.0-or-later
#include "polish.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "magnets.hpp"

namespace vitrine::mesh_room {
namespace {

/// Quality of a triangle, 1 equilateral, 0 flat, negative turned over: twice its area against its squared edges.
double quality(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = b - a, v = c - a, w = c - b;
  return 2 * std::numbers::sqrt3 * (u.x() * v.y() - u.y() * v.x()) /
         (u.squaredNorm() + v.squaredNorm() + w.squaredNorm());
}

constexpr double kGood = 0.87;  ///< [-] a right isosceles triangle; better ones are left to the magnets
constexpr int kSweeps = 8;

}  // namespace

int polish(std::vector<Vec2>& nodes, std::size_t outline_size, const std::vector<Triangle>& triangles, const Wall& wall,
           double edge_length) {
  const double h = edge_length;
  // Opposite edges of the triangles at each node, the node's star.
  std::vector<std::size_t> start(nodes.size() + 1, 0);
  for (const Triangle& t : triangles)
    for (std::uint32_t i : t) ++start[i + 1];
  for (std::size_t i = 0; i < nodes.size(); ++i) start[i + 1] += start[i];
  std::vector<std::array<std::uint32_t, 2>> star(3 * triangles.size());
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) star[next[t[k]]++] = {t[(k + 1) % 3], t[(k + 2) % 3]};

  const auto worst_at = [&](std::size_t i, const Vec2& p) {
    double worst = 1;
    for (std::size_t s = start[i]; s < start[i + 1]; ++s)
      worst = std::min(worst, quality(p, nodes[star[s][0]], nodes[star[s][1]]));
    return worst;
  };
  int moves = 0;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const int before = moves;
    for (std::size_t i = outline_size; i < nodes.size(); ++i) {
      double worst = worst_at(i, nodes[i]);
      if (worst >= kGood) continue;
      Vec2 best = nodes[i];
      for (double step : {0.2, 0.1, 0.05, 0.025}) {
        const Vec2 from = best;
        for (int direction = 0; direction < 8; ++direction) {
          const double a = direction * std::numbers::pi / 4;
          const Vec2 p = from + step * h * Vec2(std::cos(a), std::sin(a));
          const double now = worst_at(i, p);
          if (now <= worst + 1e-3 || wall.distance(p, h) < kClearance * h) continue;
          worst = now;
          best = p;
        }
      }
      if (best == nodes[i]) continue;
      nodes[i] = best;
      ++moves;
    }
    if (moves == before) break;
  }
  return moves;
}

}  // namespace vitrine::mesh_room
