// SPDX-License-Identifier: GPL-3.0-or-later
#include "boundary.hpp"

#include <cmath>

namespace vitrine::mesh_room {

double polygon_area(std::span<const Vec2> loop) {
  double twice = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 a = loop[i] - loop[0], b = loop[(i + 1) % loop.size()] - loop[0];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

Boundary::Boundary(std::span<const Vec2> outline, std::span<const Loop> holes) : start_{0} {
  const auto add = [&](std::span<const Vec2> loop, bool hole) {
    const std::size_t first = nodes_.size(), n = loop.size();
    const double area = polygon_area(loop);
    area_ += hole ? -std::abs(area) : std::abs(area);
    const double side = (area > 0) != hole ? 1 : -1;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 d = loop[(i + 1) % n] - loop[i];
      nodes_.push_back(loop[i]);
      length_.push_back(d.norm());
      inward_.push_back(side / length_.back() * Vec2(-d.y(), d.x()));
      next_.push_back(first + (i + 1) % n);
      previous_.push_back(first + (i + n - 1) % n);
    }
    start_.push_back(nodes_.size());
  };
  add(outline, false);
  for (const Loop& hole : holes) add(hole, true);
  low_ = high_ = nodes_.front();
  for (const Vec2& p : nodes_) {
    low_ = low_.cwiseMin(p);
    high_ = high_.cwiseMax(p);
  }
}

}  // namespace vitrine::mesh_room
