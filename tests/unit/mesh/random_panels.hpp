// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Seeded random panels: concave outlines with sharp corners of either turn, with and without holes.
#include "outlines.hpp"

namespace vitrine::test {

struct RandomPanel {
  double h;  ///< [m] target edge length
  Outline outline;
  std::vector<Outline> holes;
};

inline double distance_to(const Outline& p, const Vec2& q) {
  double best = 1e300;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2 a = p[i], d = p[(i + 1) % p.size()] - a;
    const double t = std::clamp((q - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (q - a - t * d).norm());
  }
  return best;
}

inline bool inside(const Outline& p, const Vec2& q) {
  bool odd = false;
  for (std::size_t i = 0, j = p.size() - 1; i < p.size(); j = i++)
    if ((p[i].y() > q.y()) != (p[j].y() > q.y()) &&
        q.x() < p[i].x() + (p[j].x() - p[i].x()) * (q.y() - p[i].y()) / (p[j].y() - p[i].y()))
      odd = !odd;
  return odd;
}

/// Two parts joined by a strap, and a slot cut into one of them: narrow parts and sharp concave corners.
inline Outline strapped(std::uint32_t seed, double h) {
  Random r(seed);
  const double w = std::min(0.15, r.between(0.5, 5) * h), slot = r.between(0.5, 3) * h, lean = r.between(-0.1, 0.1);
  const double length = r.between(0.1, 0.3), deep = r.between(0.05, 0.2);
  const Vec2 a(-0.3, 0), b(-0.1 - slot, 0), tip(-0.1 - slot / 2 + lean, deep), c(-0.1, 0), d(0.3, 0),
      e(0.3 + lean, 0.35);
  const Vec2 f(w, 0.3), g(w + lean, 0.3 + length), i(0.2 + lean, 0.35 + length), j(lean, 0.5 + length);
  const Vec2 k(-0.2 + lean, 0.35 + length), l(lean, 0.3 + length), m(0, 0.3), n(-0.3, 0.25);
  std::vector<Outline> sides;
  const std::vector<Vec2> corners = {a, b, tip, c, d, e, f, g, i, j, k, l, m, n};
  for (std::size_t x = 0; x < corners.size(); ++x) sides.push_back({corners[x], corners[(x + 1) % corners.size()]});
  // Short sides keep at least half an edge: one segment is a side's least.
  Outline outline;
  for (const Outline& side : sides) {
    const int pieces = std::max(1, static_cast<int>(std::lround((side[1] - side[0]).norm() / h)));
    for (int p = 0; p < pieces; ++p)
      outline.push_back(side[0] + (side[1] - side[0]) * (static_cast<double>(p) / pieces));
  }
  return outline;
}

inline RandomPanel random_panel(std::uint32_t seed) {
  Random r(seed + 7919);
  RandomPanel panel;
  panel.h = r.between(0.012, 0.06);
  switch (seed % 3) {
    case 0:
      panel.outline = blob(seed, panel.h);
      break;
    case 1:
      panel.outline = star(seed, panel.h);
      break;
    default:
      panel.outline = strapped(seed, panel.h);
  }
  if (seed % 2 == 1) return panel;
  for (int tries = 0; tries < 12; ++tries) {
    const double radius = r.between(0.5, 4) * panel.h, turn = r.between(0, 1);
    const Vec2 middle(r.between(-0.3, 0.3), r.between(-0.3, 0.6));
    double room = inside(panel.outline, middle) ? distance_to(panel.outline, middle) : 0;
    for (const Outline& hole : panel.holes) room = std::min(room, inside(hole, middle) ? 0 : distance_to(hole, middle));
    if (room < radius + 0.8 * panel.h) continue;
    // From a triangle to a round hole; every other one clockwise.
    const int n = std::max(3, static_cast<int>(std::lround(2 * std::numbers::pi * radius / panel.h)));
    Outline hole;
    for (int i = 0; i < n; ++i) {
      const double a = 2 * std::numbers::pi * (turn + (tries % 2 ? i : -i)) / n;
      hole.push_back(middle + radius * Vec2(std::cos(a), std::sin(a)));
    }
    panel.holes.push_back(hole);
  }
  return panel;
}

}  // namespace vitrine::test
