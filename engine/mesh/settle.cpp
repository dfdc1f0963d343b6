// SPDX-License-Identifier: GPL-3.0-or-later
#include "settle.hpp"

#include <algorithm>
#include <cmath>

namespace vitrine::mesh_room {
namespace {

constexpr double kRange = 1.1;        ///< [-] R in target edges; a little pressure keeps the sheet from gaping
constexpr double kStep = 1.2;         ///< [-] of the mean of what the neighbours ask for
constexpr double kLargestStep = 0.2;  ///< [-] in target edges
constexpr double kWallHeight = 0.85;  ///< [-] of an equilateral triangle on a wall segment, in target edges
constexpr double kLeastArea = 0.05;   ///< [-] twice the area of a triangle, in squared target edges
constexpr double kRest = 2e-3;        ///< [-] largest step, in target edges, that counts as rest
constexpr int kSweepsBetweenFlips = 3;

/// Where the neighbours push node i [m]: the forces times R^3, over the sum of (R / r)^2, which makes it the mean of
/// how far the edges are off their rest length, the shorter ones weighing more.
Vec2 push_at(const Sheet& sheet, std::uint32_t i) {
  const Vec2 p = sheet.at(i);
  const double size = sheet.size(i);
  Vec2 push = Vec2::Zero();
  double stiffness = 0;
  sheet.star(i, [&](std::uint32_t b, std::uint32_t c) {
    const Vec2 d = p - sheet.at(b);
    const double target = 0.5 * (size + sheet.size(b));
    const double t = kRange * target / d.norm();  // R / r
    push += t * t * (t - 1) * d;
    stiffness += t * t;
    if (sheet.interior(b) || sheet.interior(c)) return;
    // The wall segment itself, else a node could come close to the middle of a long one.
    const Vec2 e = sheet.at(c) - sheet.at(b);
    const double length = e.norm(), gap = cross(e, d) / length;
    push += (kWallHeight * target - gap) / length * Vec2(-e.y(), e.x());
    stiffness += 1;
  });
  return push / stiffness;
}

}  // namespace

int settle(Sheet& sheet, const std::vector<std::uint32_t>& ring, int sweeps) {
  const std::vector<std::int32_t> cells = sheet.cells_of(ring);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double largest = 0;
    for (const std::uint32_t i : ring) {
      const double size = sheet.size(i);
      Vec2 move = kStep * push_at(sheet, i);
      const double length = move.norm() / size;
      if (length > kLargestStep) move *= kLargestStep / length;
      const Vec2 target = sheet.at(i) + move;
      bool fits = true;
      sheet.star(i, [&](std::uint32_t b, std::uint32_t c) {
        fits = fits && cross(sheet.at(b) - target, sheet.at(c) - target) > kLeastArea * size * size;
      });
      if (!fits) continue;
      sheet.move(i, target);
      largest = std::max(largest, std::min(length, kLargestStep));
    }
    const bool rests = largest < kRest;
    if (rests || sweep + 1 == sweeps || sweep % kSweepsBetweenFlips == kSweepsBetweenFlips - 1) sheet.legalise(cells);
    if (rests) return sweep + 1;
  }
  return sweeps;
}

}  // namespace vitrine::mesh_room
