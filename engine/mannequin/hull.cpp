// SPDX-License-Identifier: GPL-3.0-or-later
#include "hull.hpp"

#include <algorithm>

namespace vitrine::body {

std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  if (points.size() < 3) return points;
  std::vector<Vec2> hull(2 * points.size());
  std::size_t k = 0;
  const auto turns_right = [&hull](std::size_t n, const Vec2& p) {
    const Vec2 a = hull[n - 1] - hull[n - 2], b = p - hull[n - 2];
    return a.x() * b.y() - a.y() * b.x() <= 0;
  };
  for (const Vec2& p : points) {
    while (k >= 2 && turns_right(k, p)) --k;
    hull[k++] = p;
  }
  const std::size_t lower = k + 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) {
    while (k >= lower && turns_right(k, points[i])) --k;
    hull[k++] = points[i];
  }
  hull.resize(k - 1);
  return hull;
}

double hull_perimeter(const std::vector<Vec2>& points) {
  const std::vector<Vec2> hull = convex_hull(points);
  double total = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) total += (hull[(i + 1) % hull.size()] - hull[i]).norm();
  return total;
}

}  // namespace vitrine::body
