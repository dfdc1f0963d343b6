// SPDX-License-Identifier: GPL-3.0-or-later
#include "sizing.hpp"

#include <algorithm>
#include <cmath>

namespace vitrine::mesh_room {
namespace {

constexpr double kNarrow = 4;    ///< [-] a part of fewer edges across is graded
constexpr double kFinest = 0.5;  ///< [-] of the target, in narrow parts
constexpr double kShort = 0.6;   ///< [-] shorter segments, in targets, ask for finer edges around them
constexpr double kFinestAtSegments = 1.0 / 64;
constexpr double kGrowth = 0.4;   ///< [m/m] of the edge length with the distance from a spot
constexpr double kFacing = 0.87;  ///< [-] cosine: walls within 30 degrees of parallel bound a part, others a corner

}  // namespace

Sizing::Sizing(const Boundary& boundary, const Wall& wall, double edge_length)
    : target_(edge_length), grid_(boundary.low(), boundary.high(), 2 * edge_length) {
  add_narrow_parts(boundary, wall);
  add_short_segments(boundary);
  std::vector<Vec2> centres;
  for (const Spot& s : spots_) {
    centres.push_back(s.centre);
    reach_ = std::max(reach_, radius(s, target_));
  }
  grid_.fill(centres);
}

/// The width at each segment: how far straight inwards from its middle the next wall is.
void Sizing::add_narrow_parts(const Boundary& boundary, const Wall& wall) {
  const double limit = kNarrow * target_ * (1 - 1e-9);
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    const Vec2 middle = 0.5 * (boundary[i] + boundary[boundary.next(i)]), ray = boundary.inward(i);
    const double width = wall.across(middle, ray, limit, kFacing);
    if (width < limit)
      spots_.push_back({middle + 0.5 * width * ray, 0.5 * width, std::max(width / kNarrow, kFinest * target_)});
  }
}

void Sizing::add_short_segments(const Boundary& boundary) {
  const double finest = kFinestAtSegments * target_;
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    if (boundary.segment(i) > kShort * target_) continue;
    const Vec2 centre = 0.5 * (boundary[i] + boundary[boundary.next(i)]);
    // An outline of a million points needs no more spots than its finest edges.
    if (!spots_.empty() && spots_.back().size == finest && (spots_.back().centre - centre).norm() < finest) continue;
    spots_.push_back({centre, 0, std::max(boundary.segment(i), finest)});
  }
}

double Sizing::radius(const Spot& spot, double size) {
  return spot.radius + std::max(0.0, size - spot.size) / kGrowth;
}

double Sizing::at(const Vec2& p) const {
  double size = target_;
  if (uniform()) return size;
  grid_.near(p, reach_, [&](int k) {
    const Spot& s = spots_[k];
    if (s.size >= size) return;
    size = std::min(size, s.size + kGrowth * std::max(0.0, (p - s.centre).norm() - s.radius));
  });
  return size;
}

}  // namespace vitrine::mesh_room
