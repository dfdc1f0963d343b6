// SPDX-License-Identifier: GPL-3.0-or-later
#include "wall.hpp"

#include <algorithm>
#include <cmath>

namespace vitrine::mesh_room {

Wall::Wall(const Boundary& boundary, double edge_length)
    : grid_(boundary.low(), boundary.high(), 1.5 * edge_length) {
  std::vector<Vec2> middles;
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    const int parts = std::max(1, static_cast<int>(std::ceil(boundary.segment(i) / (1.3 * edge_length))));
    const Vec2 d = (boundary[boundary.next(i)] - boundary[i]) / parts;
    for (int k = 0; k < parts; ++k) {
      pieces_.push_back({boundary[i] + k * d, d, 1 / d.squaredNorm()});
      middles.push_back(pieces_.back().a + 0.5 * d);
    }
    longest_ = std::max(longest_, d.norm());
  }
  grid_.fill(middles);
}

double Wall::distance(const Vec2& p, double limit) const {
  double best = limit * limit;
  grid_.near(p, limit + 0.5 * longest_, [&](int i) {
    const Piece& piece = pieces_[i];
    const Vec2 q = p - piece.a;
    const double t = std::clamp(q.dot(piece.d) * piece.inverse_square, 0.0, 1.0);
    best = std::min(best, (q - t * piece.d).squaredNorm());
  });
  return std::sqrt(best);
}

}  // namespace vitrine::mesh_room
