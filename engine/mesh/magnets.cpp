// SPDX-License-Identifier: GPL-3.0-or-later
#include "magnets.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace vitrine::mesh_room {
namespace {

/// Beyond this share of the target edge a magnet is not felt. It lies between the first ring of a hexagonal lattice
/// (1) and its second (1.73), so that a node is held by its six neighbours alone and the sheet comes to rest; the
/// unlimited 1/r^2 of the paper's eq. (1) lets the whole sheet press on the wall.
constexpr double kRange = 1.5;
constexpr double kMobility = 0.1;      ///< [-] step per unit force, in edge lengths; stable below 0.16
constexpr double kLargestStep = 0.15;  ///< [-] in edge lengths; less than the clearance, so no node jumps the wall
constexpr double kLookout = 2;         ///< [-] how far nodes look for the wall, in edge lengths
constexpr double kRest = 5e-4;         ///< [-] largest step, in edge lengths, that counts as rest

/// Eq. (1) with unit masses, F = G (1/r^2 - 1/R^2) for r < R: the paper's law let down to zero at its range.
/// Lengths in target edges.
double repulsion(double r_squared) {
  return 1.0 / std::max(r_squared, 0.04) - 1.0 / (kRange * kRange);
}

/// Where the outline crosses each lattice row, rows from `bottom` upwards.
std::vector<std::vector<double>> row_crossings(std::span<const Vec2> outline, double bottom, double step, int rows) {
  std::vector<std::vector<double>> crossings(rows);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    Vec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    if (a.y() > b.y()) std::swap(a, b);
    const int first = std::max(0, static_cast<int>(std::ceil((a.y() - bottom) / step)));
    for (int k = first; k < rows && bottom + k * step < b.y(); ++k)
      crossings[k].push_back(a.x() + (b.x() - a.x()) * ((bottom + k * step - a.y()) / (b.y() - a.y())));
  }
  for (auto& row : crossings) std::sort(row.begin(), row.end());
  return crossings;
}

}  // namespace

double polygon_area(std::span<const Vec2> outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i] - outline[0], b = outline[(i + 1) % outline.size()] - outline[0];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

double ideal_interior_count(double area, std::size_t outline_size, double edge_length) {
  const double triangles = area / (0.25 * std::numbers::sqrt3 * edge_length * edge_length);
  return std::max(0.0, 0.5 * (triangles - static_cast<double>(outline_size) + 2.0));
}

std::vector<Vec2> insert_magnets(std::span<const Vec2> outline, const Wall& wall, double edge_length, double shift) {
  const double h = edge_length, step = 0.5 * std::numbers::sqrt3 * h;
  const double bottom = wall.low().y() + step, middle = 0.5 * (wall.low().x() + wall.high().x());
  const int rows = std::max(0, static_cast<int>((wall.high().y() - bottom) / step) + 1);
  const auto crossings = row_crossings(outline, bottom, step, rows);

  struct Place {
    Vec2 p;
    double clearance;
  };
  std::vector<Place> places;
  for (int k = 0; k < rows; ++k) {
    const double from = middle + (k % 2 == 0 ? shift : shift + 0.5) * h, y = bottom + k * step;
    for (std::size_t c = 0; c + 1 < crossings[k].size(); c += 2) {
      const double last = std::floor((crossings[k][c + 1] - from) / h);
      for (double j = std::ceil((crossings[k][c] - from) / h); j <= last; ++j) {
        const Vec2 p(from + j * h, y);
        const double clearance = wall.distance(p, 1.2 * h);
        if (clearance >= kClearance * h) places.push_back({p, clearance});
      }
    }
  }
  const auto wanted =
      static_cast<std::size_t>(std::llround(ideal_interior_count(std::abs(polygon_area(outline)), outline.size(), h)));
  if (places.size() > wanted) {
    std::vector<std::size_t> order(places.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return places[a].clearance > places[b].clearance; });
    order.resize(wanted);
    std::sort(order.begin(), order.end());
    std::vector<Place> kept;
    for (std::size_t i : order) kept.push_back(places[i]);
    places = std::move(kept);
  }
  std::vector<Vec2> nodes;
  nodes.reserve(places.size());
  for (const Place& place : places) nodes.push_back(place.p);
  return nodes;
}

int settle(std::vector<Vec2>& nodes, std::size_t outline_size, const Wall& wall, double edge_length, int max_sweeps) {
  const double h = edge_length, reach = kRange * h;
  CellGrid fixed(wall.low(), wall.high(), reach), moving(wall.low(), wall.high(), reach);
  fixed.fill(wall.magnets());
  std::vector<Vec2> inner(nodes.begin() + static_cast<std::ptrdiff_t>(outline_size), nodes.end());
  std::vector<Vec2> push(inner.size());
  // How far each node is from the wall at least: the last measurement less what it moved since.
  std::vector<double> room(inner.size(), 0.0);
  int sweep = 0;
  for (; sweep < max_sweeps; ++sweep) {
    moving.fill(inner);
    for (std::size_t i = 0; i < inner.size(); ++i) {
      Vec2 force = Vec2::Zero();
      const auto feel = [&](const Vec2& other) {
        const Vec2 d = (inner[i] - other) / h;
        const double r_squared = d.squaredNorm();
        if (r_squared < kRange * kRange && r_squared > 0) force += d * (repulsion(r_squared) / std::sqrt(r_squared));
      };
      moving.near(inner[i], reach, [&](int j) { feel(inner[j]); });
      fixed.near(inner[i], reach, [&](int j) {
        if (wall.faces(j, inner[i])) feel(wall.magnets()[j]);
      });
      push[i] = force;
    }
    double largest = 0;
    for (std::size_t i = 0; i < inner.size(); ++i) {
      Vec2 move = kMobility * push[i];
      if (move.norm() > kLargestStep) move *= kLargestStep / move.norm();
      Vec2 target = inner[i] + h * move;
      room[i] -= h * move.norm();
      if (room[i] < kClearance * h) {
        Vec2 away;
        room[i] = wall.distance(target, kLookout * h, &away);
        if (room[i] < kClearance * h) {
          // Pressed against the wall: slide along it; stay where even that is too near.
          target += (kClearance * h - room[i]) * away;
          room[i] = 0;
          if (wall.distance(target, h) < (kClearance - 1e-6) * h) continue;
        }
      }
      largest = std::max(largest, (target - inner[i]).norm() / h);
      inner[i] = target;
    }
    if (largest < kRest) break;
  }
  std::copy(inner.begin(), inner.end(), nodes.begin() + static_cast<std::ptrdiff_t>(outline_size));
  return sweep;
}

}  // namespace vitrine::mesh_room
