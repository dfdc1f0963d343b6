// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "matching.hpp"
#include "neckline.hpp"

namespace vitrine::features_detail {
namespace {

/// The chain place of the neck point near `from`; `low` is the low point of the top edge, `shoulder` the shoulder's
/// end. The neckline sags below its chord, so that what bulges above it and climbs is a piece of the shoulder line: the
/// neck point is its highest corner. And the shoulder line falls outwards: where it climbs, `from` is a corner of a
/// label that stands in the neckline. `up` is the garment's.
int neck_corner(const Outline& outline, int from, int low, int shoulder, const Vec2& up, bool clockwise) {
  constexpr double kBulge = 0.06, kClimb = 0.04;  // of the chord
  constexpr double kSlope = 0.15;
  const int n = static_cast<int>(outline.chain.size());
  const auto steps = [&](int a, int b) { return clockwise ? (b - a + n) % n : (a - b + n) % n; };
  const Vec2 start = outline.chain[from], along = outline.chain[low] - start;
  const double length = along.norm();
  if (length < 4) return from;
  const Vec2 across = (clockwise ? 1 : -1) * Vec2(along.y(), -along.x()) / length;
  int corner = from;
  double best = kClimb * length;
  for (const Candidate& c : outline.candidates) {
    const Vec2 way = c.pixel - start;
    const double climb = way.dot(up);
    if (c.turn_deg < 35 || climb <= best) continue;
    const bool inwards = steps(from, c.contour_index) < steps(from, low) && way.dot(across) > kBulge * length;
    const bool outwards = steps(c.contour_index, from) < steps(shoulder, from) && climb > kSlope * way.norm();
    if (!inwards && !outwards) continue;
    best = climb;
    corner = c.contour_index;
  }
  return corner;
}

}  // namespace

void settle_neck_points(const Outline& outline, const GarmentTemplate& garment, double tilt_deg,
                        std::vector<int>& place) {
  const TemplateEdge& neck = garment.edges[garment.neck_edge()];
  const int n = static_cast<int>(outline.chain.size());
  const double tilt = tilt_deg * std::numbers::pi / 180;
  const Vec2 up(std::sin(tilt), -std::cos(tilt)), from = outline.chain[place[neck.from]];
  const Vec2 along = outline.chain[place[neck.to]] - from;
  int low = place[neck.from];
  double depth = -1e30;
  for (int i = place[neck.from];; i = (i + 1) % n) {
    const Vec2 p = outline.chain[i] - from;
    const double down = along.x() * p.y() - along.y() * p.x();
    if (down > depth) {
      depth = down;
      low = i;
    }
    if (i == place[neck.to]) break;
  }
  // The features next to the neck points on the outline.
  const std::vector<int> order = outline_order(garment);
  const int count = static_cast<int>(order.size());
  const auto beside = [&](int feature, int step) {
    const auto at = std::find(order.begin(), order.end(), feature) - order.begin();
    return place[order[(static_cast<int>(at) + step + count) % count]];
  };
  const int left = neck_corner(outline, place[neck.from], low, beside(neck.from, -1), up, true);
  const int right = neck_corner(outline, place[neck.to], low, beside(neck.to, 1), up, false);
  place[neck.from] = left;
  place[neck.to] = right;
}

}  // namespace vitrine::features_detail
