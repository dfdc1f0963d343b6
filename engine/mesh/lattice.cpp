// SPDX-License-Identifier: GPL-3.0-or-later
#include "lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace vitrine::mesh_room {
namespace {

using std::numbers::pi;

/// Reciprocal vectors of the three families of lattice rows [1/m]: at a site every one of them has phase 0.
std::array<Vec2, 3> row_waves(double angle, double step) {
  std::array<Vec2, 3> waves;
  const double length = 4 * pi / (std::numbers::sqrt3 * step);
  for (int k = 0; k < 3; ++k) {
    const double a = angle + pi / 2 + k * pi / 3;
    waves[k] = length * Vec2(std::cos(a), std::sin(a));
  }
  return waves;
}

/// How well sites coincide with the boundary's nodes for the best shift; higher is better.
double coherence(const Boundary& boundary, const Vec2& middle, Lattice& lattice) {
  const auto waves = row_waves(lattice.angle, lattice.step);
  std::array<std::complex<double>, 3> sum{};
  for (const Vec2& p : boundary.nodes())
    for (int k = 0; k < 3; ++k) sum[k] += std::polar(1.0, waves[k].dot(p - middle));
  constexpr int kTries = 12;
  double best = -1e300;
  const Vec2 u = lattice.step * Vec2(std::cos(lattice.angle), std::sin(lattice.angle));
  const Vec2 v = lattice.step * Vec2(std::cos(lattice.angle + pi / 3), std::sin(lattice.angle + pi / 3));
  for (int i = 0; i < kTries; ++i)
    for (int j = 0; j < kTries; ++j) {
      const Vec2 shift = (u * i + v * j) / kTries;
      double value = 0;
      for (int k = 0; k < 3; ++k) value += (sum[k] * std::polar(1.0, -waves[k].dot(shift))).real();
      if (value > best + 1e-9) {
        best = value;
        lattice.origin = middle + shift;
      }
    }
  return best;
}

}  // namespace

Lattice fit_lattice(const Boundary& boundary, double step) {
  const Vec2 middle = 0.5 * (boundary.low() + boundary.high());
  Lattice best;
  double best_value = -1e300;
  constexpr int kAngles = 12;
  for (int a = 0; a < kAngles; ++a) {
    Lattice lattice{middle, a * pi / 3 / kAngles, step};
    const double value = coherence(boundary, middle, lattice);
    if (value > best_value + 1e-9) {
      best_value = value;
      best = lattice;
    }
  }
  return best;
}

std::vector<Vec2> insert_nodes(const Boundary& boundary, const Wall& wall, const Lattice& lattice, double clearance) {
  const double c = std::cos(lattice.angle), s = std::sin(lattice.angle), h = lattice.step;
  const double height = 0.5 * std::numbers::sqrt3 * h;
  // In the lattice's own frame rows are level: x along the axis, row k at y = k * height, every row half a step on.
  const auto turned = [&](const Vec2& p) {
    const Vec2 d = p - lattice.origin;
    return Vec2(c * d.x() + s * d.y(), c * d.y() - s * d.x());
  };
  std::vector<Vec2> own(boundary.size());
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < own.size(); ++i) {
    own[i] = turned(boundary[i]);
    low = std::min(low, own[i].y());
    high = std::max(high, own[i].y());
  }
  const double first = std::ceil(low / height);
  const int rows = std::max(0, static_cast<int>(std::floor(high / height) - first) + 1);
  std::vector<std::vector<double>> crossings(rows);
  for (std::size_t i = 0; i < own.size(); ++i) {
    Vec2 a = own[i], b = own[boundary.next(i)];
    if (a.y() > b.y()) std::swap(a, b);
    const int from = std::max(0, static_cast<int>(std::ceil(a.y() / height - first)));
    for (int k = from; k < rows && (first + k) * height < b.y(); ++k)
      crossings[k].push_back(a.x() + (b.x() - a.x()) * (((first + k) * height - a.y()) / (b.y() - a.y())));
  }
  std::vector<Vec2> nodes;
  for (int k = 0; k < rows; ++k) {
    std::sort(crossings[k].begin(), crossings[k].end());
    const double y = (first + k) * height, start = 0.5 * h * (first + k);
    for (std::size_t x = 0; x + 1 < crossings[k].size(); x += 2) {
      const double last = std::floor((crossings[k][x + 1] - start) / h);
      for (double j = std::ceil((crossings[k][x] - start) / h); j <= last; ++j) {
        const double along = start + j * h;
        const Vec2 p = lattice.origin + Vec2(c * along - s * y, s * along + c * y);
        if (wall.distance(p, clearance) >= clearance) nodes.push_back(p);
      }
    }
  }
  return nodes;
}

}  // namespace vitrine::mesh_room
