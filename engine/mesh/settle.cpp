// SPDX-License-Identifier: GPL-3.0-or-later
#include "settle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace vitrine::mesh_room {
namespace {
double param(const char* n, double d) { const char* s = std::getenv(n); return s ? std::atof(s) : d; }
}

namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

std::vector<std::int32_t> cells_of(const Sheet& sheet, const std::vector<std::uint32_t>& ring) {
  std::vector<char> seen(sheet.cells().size(), 0);
  std::vector<std::int32_t> cells;
  for (const std::uint32_t i : ring)
    if (sheet.alive(i))
      sheet.cells_at(i, [&](std::int32_t c) {
        if (!seen[c]) {
          seen[c] = 1;
          cells.push_back(c);
        }
      });
  return cells;
}
}

int settle(Sheet& sheet, const std::vector<std::uint32_t>& ring, int sweeps) {
  const double rest = param("REST", 1.1), over = param("OVER", 1.3), FOOT = param("FOOT", 0), FH = param("FH", 0.85);
  const int every = (int)param("EVERY", 2);
  const double W2 = param("W2", 0);
  const std::vector<std::int32_t> cells = cells_of(sheet, ring);
  int sweep = 0;
  for (; sweep < sweeps; ++sweep) {
    double largest = 0;
    for (const std::uint32_t i : ring) {
      if (!sheet.alive(i)) continue;
      const Vec2 p = sheet.at(i);
      const double size = sheet.size(i);
      Vec2 push = Vec2::Zero();
      double weight = 0;
      sheet.star(i, [&](std::uint32_t b, std::uint32_t c) {
        const Vec2 d = p - sheet.at(b);
        const double l = 0.5 * (size + sheet.size(b));
        const double t = rest * l / d.norm();
        const double w = W2 > 0 ? 1 - W2 + W2 * t * t : 1;
        push += w * (t - 1) * d;
        weight += w;
        if (FOOT > 0 && !sheet.interior(b) && !sheet.interior(c)) {
          const Vec2 e = sheet.at(c) - sheet.at(b);
          const double len = e.norm(), gap = cross(e, d) / len;
          push += FOOT * (FH * l - gap) / len * Vec2(-e.y(), e.x());
          weight += FOOT;
        }
      });
      Vec2 move = over / weight * push;
      const double length = move.norm();
      if (length > 0.2 * size) move *= 0.2 * size / length;
      const Vec2 target = p + move;
      bool fits = true;
      sheet.star(i, [&](std::uint32_t b, std::uint32_t c) {
        fits = fits && cross(sheet.at(b) - target, sheet.at(c) - target) > 0.05 * size * size;
      });
      if (!fits) continue;
      sheet.move(i, target);
      largest = std::max(largest, std::min(length, 0.2 * size) / size);
    }
    if (sweep % every == every - 1 || sweep + 1 == sweeps) sheet.legalise(cells);
    if (largest < 2e-3) break;
  }
  sheet.legalise(cells);
  return sweep;
}

namespace {
/// What is wrong with a triangle: 0 when its edge ratio is above 1.6 and its smallest angle well above 35 degrees.
double fault(const Vec2& a, const Vec2& b, const Vec2& c) {
  static const double A = param("FA", 1.0), B = param("FB", 3.0), C = param("FC", 4.0), R1=param("R1",1.63), R2=param("R2",1.36), SIN = param("FS", 0.62);
  const Vec2 u = b - a, v = c - b, w = a - c;
  const double area = cross(u, v);
  if (area <= 0) return 100;
  double p = u.squaredNorm(), q = v.squaredNorm(), r = w.squaredNorm();
  if (p > q) std::swap(p, q);
  if (q > r) std::swap(q, r);
  if (p > q) std::swap(p, q);
  // Most triangles are near enough to equilateral to need no roots: p > r * 0.64 gives ratio > 1.6.
  if (p > 0.6724 * r) return 0;
  const double longest = std::sqrt(r), middle = std::sqrt(q), ratio = (std::sqrt(p) + middle) / longest;
  const double sine = area / (middle * longest);  // of the smallest angle
  return A * std::max(0.0, R1 - ratio) + B * std::max(0.0, R2 - ratio) + C * std::max(0.0, SIN - sine);
}
}

void polish(Sheet& sheet, const std::vector<std::uint32_t>& ring, int rounds) {
  const double SP = param("SP", 0.02);
  const std::vector<std::int32_t> cells = cells_of(sheet, ring);
  const auto faults_at = [&](std::uint32_t i, const Vec2& p) {
    double sum = 0;
    const double size = sheet.size(i);
    sheet.star(i, [&](std::uint32_t b, std::uint32_t c) {
      sum += fault(p, sheet.at(b), sheet.at(c));
      const double l = 0.5 * (size + sheet.size(b));
      const double d = (p - sheet.at(b)).squaredNorm() / (l * l) - 1;
      sum += SP * d * d;
    });
    return sum;
  };
  static const Vec2 directions[6] = {{1, 0}, {0.5, 0.8660254037844386}, {-0.5, 0.8660254037844386},
                                    {-1, 0}, {-0.5, -0.8660254037844386}, {0.5, -0.8660254037844386}};
  std::vector<char> bad(sheet.node_slots(), 0);
  for (int round = 0; round < rounds; ++round) {
    std::fill(bad.begin(), bad.end(), 0);
    for (const std::int32_t c : cells) {
      if (!sheet.cell_alive(c)) continue;
      const Triangle& t = sheet.cells()[c].node;
      if (fault(sheet.at(t[0]), sheet.at(t[1]), sheet.at(t[2])) > 0)
        for (const std::uint32_t i : t) bad[i] = 1;
    }
    const double step = param("STEP", 0.1) * std::pow(0.7, round);
    int moved = 0;
    for (const std::uint32_t i : ring) {
      if (!bad[i] || !sheet.alive(i)) continue;
      const double size = sheet.size(i);
      const Vec2 from = sheet.at(i);
      Vec2 best = from;
      double least = faults_at(i, best);
      for (double s = step; s > 0.2 * step; s *= 0.5) {
        const Vec2 centre = best;
        for (const Vec2& d : directions) {
          const Vec2 p = centre + s * size * d;
          const double now = faults_at(i, p);
          if (now < least - 1e-6) {
            least = now;
            best = p;
          }
        }
      }
      if (best != from) {
        sheet.move(i, best);
        ++moved;
      }
    }
    sheet.legalise(cells);
    if (!moved) break;
  }
}

}  // namespace vitrine::mesh_room
