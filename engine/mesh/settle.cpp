// SPDX-License-Identifier: GPL-3.0-or-later
#include "settle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace vitrine::mesh_room {
namespace {
double param(const char* n, double d) { const char* s = std::getenv(n); return s ? std::atof(s) : d; }
}

std::vector<std::uint32_t> ring_of_wall(const Sheet& sheet, int depth) {
  std::vector<int> level(sheet.node_slots(), -1);
  std::vector<std::uint32_t> front, ring;
  for (std::uint32_t i = 0; i < sheet.wall_size(); ++i) {
    level[i] = 0;
    front.push_back(i);
  }
  for (int d = 1; d <= depth; ++d) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t i : front)
      sheet.star(i, [&](std::uint32_t b, std::uint32_t c) {
        for (const std::uint32_t j : {b, c})
          if (level[j] < 0) {
            level[j] = d;
            next.push_back(j);
          }
      });
    ring.insert(ring.end(), next.begin(), next.end());
    front = std::move(next);
  }
  std::sort(ring.begin(), ring.end());
  return ring;
}

int settle(Sheet& sheet, const std::vector<std::uint32_t>& ring, double h, int sweeps) {
  const double rest = param("REST", 1.0) * h, over = param("OVER", 1.0), power = param("POW", 1);
  int sweep = 0;
  for (; sweep < sweeps; ++sweep) {
    double largest = 0;
    for (const std::uint32_t i : ring) {
      if (!sheet.alive(i)) continue;
      const Vec2 p = sheet.at(i);
      Vec2 push = Vec2::Zero();
      double weight = 0;
      sheet.star(i, [&](std::uint32_t b, std::uint32_t) {
        const Vec2 d = p - sheet.at(b);
        const double r = d.norm();
        double w = 1;
        if (power != 1) w = std::pow(rest / r, power);
        push += w * (rest / r - 1) * d;
        weight += w;
      });
      // Stiffness of a spring star in the plane: half along, half across.
      Vec2 move = over / weight * push;
      const double length = move.norm();
      if (length > 0.2 * h) move *= 0.2 * h / length;
      const Vec2 target = p + move;
      bool fits = true;
      sheet.star(i, [&](std::uint32_t b, std::uint32_t c) {
        const Vec2 u = sheet.at(b) - target, v = sheet.at(c) - target;
        fits = fits && u.x() * v.y() - u.y() * v.x() > 0.05 * h * h;
      });
      if (!fits) continue;
      sheet.move(i, target);
      largest = std::max(largest, move.norm());
    }
    for (const std::uint32_t i : ring)
      if (sheet.alive(i)) sheet.legalise(i);
    if (largest < 2e-3 * h) break;
  }
  return sweep;
}

}  // namespace vitrine::mesh_room
