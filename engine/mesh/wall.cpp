// SPDX-License-Identifier: GPL-3.0-or-later
#include "wall.hpp"

#include <algorithm>
#include <cmath>

namespace vitrine::mesh_room {

Wall::Wall(const Boundary& boundary, double edge_length)
    : boundary_(boundary), grid_(boundary.low(), boundary.high(), 1.5 * edge_length) {
  std::vector<Vec2> middles;
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    const int parts = std::max(1, static_cast<int>(std::ceil(boundary.segment(i) / (1.3 * edge_length))));
    const Vec2 d = (boundary[boundary.next(i)] - boundary[i]) / parts;
    for (int k = 0; k < parts; ++k) {
      pieces_.push_back({boundary[i] + k * d, d, 1 / d.squaredNorm(), static_cast<int>(i)});
      middles.push_back(pieces_.back().a + 0.5 * d);
    }
    longest_ = std::max(longest_, d.norm());
  }
  grid_.fill(middles);
}

Wall::Nearest Wall::nearest(const Vec2& p, double limit) const {
  double best = limit * limit, at = 0;
  int found = -1;
  grid_.near(p, limit + 0.5 * longest_, [&](int i) {
    const Piece& piece = pieces_[i];
    const Vec2 q = p - piece.a;
    const double t = std::clamp(q.dot(piece.d) * piece.inverse_square, 0.0, 1.0);
    const double squared = (q - t * piece.d).squaredNorm();
    if (squared < best) {
      best = squared;
      found = i;
      at = t;
    }
  });
  if (found < 0) return {limit};
  const Piece& piece = pieces_[found];
  // Where two segments meet, the sum of their normals tells the sides apart.
  const std::size_t s = piece.segment;
  Vec2 normal = boundary_.inward(s);
  Vec2 foot = piece.a + at * piece.d;
  if (at == 0 && foot == boundary_[s]) normal += boundary_.inward(boundary_.previous(s));
  if (at == 1) normal += boundary_.inward(ends_segment(found) ? boundary_.next(s) : s);
  return {std::sqrt(best), piece.d.norm(), (p - foot).dot(normal) > 0};
}

double Wall::across(const Vec2& p, const Vec2& ray, double limit, double cosine) const {
  double width = limit;
  grid_.near(p + 0.5 * limit * ray, 0.5 * (limit + longest_), [&](int i) {
    const Piece& piece = pieces_[i];
    if (boundary_.inward(piece.segment).dot(ray) > -cosine) return;
    const Vec2 a = piece.a - p, d = piece.d;
    const double slope = ray.x() * d.y() - ray.y() * d.x();
    if (slope == 0) return;
    const double along = (a.x() * d.y() - a.y() * d.x()) / slope, part = (a.x() * ray.y() - a.y() * ray.x()) / slope;
    if (along > 0 && along < width && part >= 0 && part <= 1) width = along;
  });
  return width;
}

}  // namespace vitrine::mesh_room
