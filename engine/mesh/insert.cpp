// SPDX-License-Identifier: GPL-3.0-or-later
#include "insert.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vitrine::mesh_room {
namespace {

constexpr double kClearance = 0.5;  ///< [-] nearest to the wall, in edges of the place or of the wall
constexpr double kRim = 2;          ///< [-] width of the rim in target edges; neighbours of the ring are nearer
constexpr int kLevels = 6;          ///< finest lattice: 1/64 of the target

/// The sites of a lattice that lie on the cloth, row by row.
template <class Visit>
void sites_inside(const Boundary& boundary, const Lattice& lattice, Visit&& visit) {
  const Vec2 x_axis = lattice.axis, y_axis(-x_axis.y(), x_axis.x());
  const double h = lattice.step, height = 0.5 * std::numbers::sqrt3 * h;
  std::vector<Vec2> own(boundary.size());  // in the lattice's frame, where rows are level
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < own.size(); ++i) {
    const Vec2 d = boundary[i] - lattice.origin;
    own[i] = {d.dot(x_axis), d.dot(y_axis)};
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
  for (int k = 0; k < rows; ++k) {
    std::sort(crossings[k].begin(), crossings[k].end());
    const double y = (first + k) * height, start = 0.5 * h * (first + k);
    for (std::size_t c = 0; c + 1 < crossings[k].size(); c += 2) {
      const double last = std::floor((crossings[k][c + 1] - start) / h);
      for (double j = std::ceil((crossings[k][c] - start) / h); j <= last; ++j)
        visit(Vec2(lattice.origin + (start + j * h) * x_axis + y * y_axis));
    }
  }
}

/// The sites within `radius` of `centre`, as (row, place in the row).
void sites_around(const Lattice& lattice, const Vec2& centre, double radius, std::vector<std::array<long, 2>>& sites) {
  const double h = lattice.step, height = 0.5 * std::numbers::sqrt3 * h;
  const Vec2 d = centre - lattice.origin;
  const double x = d.dot(lattice.axis), y = d.dot(Vec2(-lattice.axis.y(), lattice.axis.x()));
  for (double k = std::ceil((y - radius) / height); k * height <= y + radius; ++k) {
    const double rise = k * height - y, reach = std::sqrt(std::max(0.0, radius * radius - rise * rise));
    for (double j = std::ceil((x - reach) / h - 0.5 * k); (j + 0.5 * k) * h <= x + reach; ++j)
      sites.push_back({static_cast<long>(k), static_cast<long>(j)});
  }
}

/// Sites of the lattice of half the step, and so on, where the edges asked for are nearer to that step.
void insert_finer(const Ground& ground, Lattice lattice, std::vector<Vec2>& nodes, std::size_t max_nodes) {
  const Sizing& sizing = ground.sizing;
  const Vec2 x_axis = lattice.axis, y_axis(-x_axis.y(), x_axis.x());
  for (int level = 1; level <= kLevels; ++level) {
    const double limit = std::numbers::sqrt2 / 2 * lattice.step;
    lattice.step *= 0.5;
    const double h = lattice.step, height = 0.5 * std::numbers::sqrt3 * h;
    std::vector<std::array<long, 2>> sites;
    for (const Sizing::Spot& spot : sizing.spots())
      if (spot.size <= limit) sites_around(lattice, spot.centre, sizing.radius(spot, limit), sites);
    if (sites.empty()) return;
    std::sort(sites.begin(), sites.end());
    sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
    for (const auto& [k, j] : sites) {
      if (nodes.size() > max_nodes) return;
      if (k % 2 == 0 && j % 2 == 0) continue;  // a site of the lattice before
      const Vec2 p = lattice.origin + (static_cast<double>(j) + 0.5 * static_cast<double>(k)) * h * x_axis +
                     static_cast<double>(k) * height * y_axis;
      const double size = sizing.at(p);
      if (size > limit) continue;
      if (ground.is_clear(p, size)) nodes.push_back(p);
    }
  }
}

}  // namespace

bool Ground::is_clear(const Vec2& p, double size) const {
  const double h = sizing.target();
  const Wall::Nearest nearest = wall.nearest(p, 4 * h);
  return nearest.inside && nearest.distance >= kClearance * std::max(size, std::min(h, nearest.edge));
}

Inserted insert_nodes(const Ground& ground, const Lattice& lattice, double depth, std::size_t max_nodes) {
  Inserted made;
  const double h = lattice.step;
  sites_inside(ground.boundary, lattice, [&](const Vec2& p) {
    if (made.ring.size() + made.rim.size() + made.deep.size() > max_nodes) return;
    const Wall::Nearest nearest = ground.wall.nearest(p, (depth + kRim) * h);
    const double size = ground.sizing.at(p);
    if (nearest.distance < kClearance * std::max(size, std::min(h, nearest.edge))) return;
    const double gap = nearest.distance / h;
    (gap < depth || size < h ? made.ring : (gap < depth + kRim ? made.rim : made.deep)).push_back(p);
  });
  if (!ground.sizing.uniform()) insert_finer(ground, lattice, made.ring, max_nodes);
  return made;
}

}  // namespace vitrine::mesh_room
