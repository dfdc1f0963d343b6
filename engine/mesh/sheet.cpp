// SPDX-License-Identifier: GPL-3.0-or-later
#include "sheet.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace vitrine::mesh_room {
namespace {

/// Below this sine of the angle excess an edge stays as it is, so that rounding cannot flip it to and fro.
constexpr double kExcess = 1e-9;

}  // namespace

Sheet::Sheet(std::vector<Vec2> nodes, std::vector<double> sizes, std::size_t wall_size,
             const std::vector<Triangle>& triangles)
    : nodes_(std::move(nodes)), sizes_(std::move(sizes)), wall_(wall_size) {
  cells_.reserve(triangles.size() + triangles.size() / 8);
  for (const Triangle& t : triangles) cells_.push_back({t, {kNone, kNone, kNone}});
  at_.assign(nodes_.size(), kNone);
  // Half edges by their smaller node: the two that share both ends are neighbours.
  std::vector<std::int32_t> first(nodes_.size(), kNone), chain(3 * cells_.size(), kNone);
  for (std::size_t c = 0; c < cells_.size(); ++c)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = cells_[c].node[(k + 1) % 3], b = cells_[c].node[(k + 2) % 3];
      const std::uint32_t low = std::min(a, b), high = std::max(a, b);
      const auto half = static_cast<std::int32_t>(3 * c + k);
      std::int32_t* link = &first[low];
      while (*link != kNone) {
        const std::int32_t other = *link;
        const Cell& cell = cells_[other / 3];
        const int j = other % 3;
        if (std::max(cell.node[(j + 1) % 3], cell.node[(j + 2) % 3]) == high) break;
        link = &chain[other];
      }
      if (*link == kNone) {
        *link = half;
      } else {
        const std::int32_t other = *link;
        cells_[c].next[k] = other / 3;
        cells_[other / 3].next[other % 3] = static_cast<std::int32_t>(c);
        *link = chain[other];
      }
    }
  for (std::size_t c = 0; c < cells_.size(); ++c) hold(static_cast<std::int32_t>(c));
}

double Sheet::twice_area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  return cross(nodes_[b] - nodes_[a], nodes_[c] - nodes_[a]);
}

/// Makes the cell the one that its nodes are entered by; a wall node by the cell that has wall clockwise of it.
void Sheet::hold(std::int32_t c) {
  const Cell& cell = cells_[c];
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t i = cell.node[k];
    if (interior(i) || cell.next[(k + 2) % 3] == kNone) at_[i] = c;
  }
}

void Sheet::replace(std::int32_t c, std::int32_t from, std::int32_t to) {
  if (c != kNone) cells_[c].next[side(cells_[c], from)] = to;
}

int Sheet::valence(std::uint32_t i) const {
  int n = interior(i) ? 0 : 1;
  star(i, [&](std::uint32_t, std::uint32_t) { ++n; });
  return n;
}

std::vector<std::int32_t> Sheet::cells_of(const std::vector<std::uint32_t>& nodes) const {
  std::vector<char> seen(cells_.size(), 0);
  std::vector<std::int32_t> cells;
  for (const std::uint32_t i : nodes)
    cells_at(i, [&](std::int32_t c) {
      if (!seen[c]) cells.push_back(c);
      seen[c] = 1;
    });
  return cells;
}

bool Sheet::can_flip(std::int32_t c, int k) const {
  const Cell& cell = cells_[c];
  const std::int32_t d = cell.next[k];
  if (d == kNone) return false;
  const std::uint32_t far = cells_[d].node[side(cells_[d], c)];
  const std::uint32_t near = cell.node[k], a = cell.node[(k + 1) % 3], b = cell.node[(k + 2) % 3];
  const double least = 1e-6 * (nodes_[near] - nodes_[far]).squaredNorm();
  return twice_area(near, a, far) > least && twice_area(near, far, b) > least;
}

/// The two angles that look at the edge sum to at most a half turn.
bool Sheet::is_delaunay(std::int32_t c, int k) const {
  const Cell& cell = cells_[c];
  const std::int32_t d = cell.next[k];
  if (d == kNone) return true;
  const Vec2 &near = nodes_[cell.node[k]], &far = nodes_[cells_[d].node[side(cells_[d], c)]];
  const Vec2 &a = nodes_[cell.node[(k + 1) % 3]], &b = nodes_[cell.node[(k + 2) % 3]];
  const Vec2 u = a - near, v = b - near, w = b - far, x = a - far;
  const double sine = cross(u, v) * w.dot(x) + u.dot(v) * cross(w, x);
  return sine >= -kExcess * (u.squaredNorm() + v.squaredNorm()) * (w.squaredNorm() + x.squaredNorm());
}

void Sheet::flip(std::int32_t c, int k) {
  const std::int32_t d = cells_[c].next[k];
  const Cell one = cells_[c], two = cells_[d];
  const int j = side(two, c);
  const std::uint32_t near = one.node[k], a = one.node[(k + 1) % 3], b = one.node[(k + 2) % 3], far = two.node[j];
  // `two` reads far, b, a.
  const std::int32_t near_a = one.next[(k + 2) % 3], b_near = one.next[(k + 1) % 3];
  const std::int32_t far_b = two.next[(j + 2) % 3], a_far = two.next[(j + 1) % 3];
  cells_[c] = {{near, a, far}, {a_far, d, near_a}};
  cells_[d] = {{near, far, b}, {far_b, b_near, c}};
  replace(a_far, d, c);
  replace(b_near, c, d);
  hold(c);
  hold(d);
}

/// Flips one edge of the cell that is not Delaunay, if there is one, and notes both cells to be looked at again.
bool Sheet::flip_illegal(std::int32_t c) {
  for (int k = 0; k < 3; ++k) {
    if (is_delaunay(c, k) || !can_flip(c, k)) continue;
    stack_.push_back(c);
    stack_.push_back(cells_[c].next[k]);
    flip(c, k);
    return true;
  }
  return false;
}

int Sheet::legalise(const std::vector<std::int32_t>& cells) {
  int flips = 0;
  // The bound only matters where rounding has the last word; Delaunay flips come to an end by themselves.
  std::size_t budget = 20 * cells.size() + 100;
  for (const std::int32_t c : cells) {
    if (!cell_alive(c)) continue;
    for (int k = 0; k < 3; ++k) {
      // Of two neighbours the one with the smaller index looks at their edge, once for both.
      if (cells_[c].next[k] < c || is_delaunay(c, k) || !can_flip(c, k)) continue;
      stack_.assign({c, cells_[c].next[k]});
      flip(c, k);
      ++flips;
      while (!stack_.empty()) {
        if (budget-- == 0) return flips;
        const std::int32_t d = stack_.back();
        stack_.pop_back();
        flips += flip_illegal(d);
      }
    }
  }
  return flips;
}

int Sheet::legalise(std::uint32_t i) {
  stack_.clear();
  cells_at(i, [&](std::int32_t c) { stack_.push_back(c); });
  int flips = 0;
  for (int budget = 200; !stack_.empty() && budget > 0; --budget) {
    const std::int32_t c = stack_.back();
    stack_.pop_back();
    flips += flip_illegal(c);
  }
  return flips;
}

std::int32_t Sheet::split(std::int32_t c, int k) {
  const std::int32_t d = cells_[c].next[k];
  if (d == kNone) return kNone;
  const Cell one = cells_[c], two = cells_[d];
  const int j = side(two, c);
  const std::uint32_t near = one.node[k], a = one.node[(k + 1) % 3], b = one.node[(k + 2) % 3], far = two.node[j];
  const std::int32_t b_near = one.next[(k + 1) % 3], near_a = one.next[(k + 2) % 3];
  const std::int32_t a_far = two.next[(j + 1) % 3], far_b = two.next[(j + 2) % 3];
  const auto m = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(0.5 * (nodes_[a] + nodes_[b]));
  sizes_.push_back(0.5 * (sizes_[a] + sizes_[b]));
  const auto e = static_cast<std::int32_t>(cells_.size()), f = e + 1;
  cells_[c] = {{near, a, m}, {f, e, near_a}};
  cells_[d] = {{far, b, m}, {e, f, far_b}};
  cells_.push_back({{near, m, b}, {d, b_near, c}});
  cells_.push_back({{far, m, a}, {c, a_far, d}});
  at_.push_back(c);
  replace(b_near, c, e);
  replace(a_far, d, f);
  for (const std::int32_t cell : {c, d, e, f}) hold(cell);
  return static_cast<std::int32_t>(m);
}

bool Sheet::remove(std::uint32_t i) {
  // Edges at the node are flipped away until three are left; the three triangles then become one.
  for (int n = valence(i); n > 3; --n) {
    std::int32_t best = kNone;
    double best_angle = -1;
    cells_at(i, [&](std::int32_t c) {
      const Cell& cell = cells_[c];
      const int k = (corner(cell, i) + 1) % 3;  // the edge from i to the third node
      if (!can_flip(c, k)) return;
      const std::uint32_t far = cells_[cell.next[k]].node[side(cells_[cell.next[k]], c)];
      const std::uint32_t b = cell.node[k], m = cell.node[(k + 1) % 3];
      // Of the triangle that is cut off: the largest sine at m keeps what is left convex.
      const Vec2 u = nodes_[b] - nodes_[m], v = nodes_[far] - nodes_[m];
      const double angle = cross(v, u) / std::sqrt(u.squaredNorm() * v.squaredNorm());
      if (std::abs(angle) > best_angle) {
        best_angle = std::abs(angle);
        best = c;
      }
    });
    if (best == kNone) return false;
    flip(best, (corner(cells_[best], i) + 1) % 3);
  }
  std::array<std::int32_t, 3> c{};
  int n = 0;
  cells_at(i, [&](std::int32_t cell) { c[n++] = cell; });
  std::array<std::uint32_t, 3> ring{};
  std::array<std::int32_t, 3> outside{};
  for (int j = 0; j < 3; ++j) {
    const int k = corner(cells_[c[j]], i);
    ring[j] = cells_[c[j]].node[(k + 1) % 3];
    outside[j] = cells_[c[j]].next[k];
  }
  if (twice_area(ring[0], ring[1], ring[2]) <= 0) return false;
  cells_[c[0]] = {{ring[0], ring[1], ring[2]}, {outside[1], outside[2], outside[0]}};
  replace(outside[1], c[1], c[0]);
  replace(outside[2], c[2], c[0]);
  cells_[c[1]] = cells_[c[2]] = {{0, 0, 0}, {kNone, kNone, kNone}};
  at_[i] = kNone;
  hold(c[0]);
  for (const std::uint32_t r : ring) legalise(r);
  return true;
}

std::vector<Vec2> Sheet::nodes() const {
  std::vector<Vec2> left;
  left.reserve(nodes_.size());
  for (std::uint32_t i = 0; i < nodes_.size(); ++i)
    if (alive(i)) left.push_back(nodes_[i]);
  return left;
}

}  // namespace vitrine::mesh_room
