// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_levels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vitrine::panels_room {
namespace {

constexpr double kMostGrowth = 1.5;  ///< [-] a garment that would have to grow further was not made for this body

/// Horizontal extent [px] of the upright outline at height y; 0 where it does not reach.
double width_at(const std::vector<Vec2>& outline, double y) {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Vec2 &a = outline[j], &b = outline[i];
    if ((a.y() > y) == (b.y() > y)) continue;
    const double x = a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y());
    low = std::min(low, x);
    high = std::max(high, x);
  }
  return std::max(0.0, high - low);
}

}  // namespace

double scale_for_body(double metres_per_pixel, const std::vector<Vec2>& outline, double anchor_y,
                      const std::vector<BodyLevel>& levels) {
  const double most = kMostGrowth * metres_per_pixel;
  // A larger garment reaches other parts of the picture's outline at the same level: a few rounds settle it.
  for (int round = 0; round < 8; ++round) {
    double needed = metres_per_pixel;
    for (const BodyLevel& level : levels) {
      if (!(level.drop > 0)) continue;
      const double width = width_at(outline, anchor_y + level.drop / metres_per_pixel);
      if (width > 1) needed = std::max(needed, 0.5 * level.girth / width);
    }
    if (needed <= metres_per_pixel * 1.001) break;
    metres_per_pixel = std::min(needed, most);
  }
  return metres_per_pixel;
}

}  // namespace vitrine::panels_room
