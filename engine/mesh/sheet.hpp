// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "vitrine/model/geometry.hpp"

namespace vitrine::mesh_room {

/// Twice the area that a and b span, counter-clockwise.
inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The triangulation while nodes move: triangles that know their neighbours, so that a change costs what it touches and
/// not a triangulation of everything. Wall edges have no neighbour; they are never flipped, split or moved.
class Sheet {
 public:
  static constexpr std::int32_t kNone = -1;
  struct Cell {
    Triangle node;                     ///< counter-clockwise
    std::array<std::int32_t, 3> next;  ///< neighbour across the edge opposite to node k, kNone at the wall
  };

  /// `sizes` are the edge lengths asked for at the nodes, the first wall_size of which are the boundary's.
  Sheet(std::vector<Vec2> nodes, std::vector<double> sizes, std::size_t wall_size,
        const std::vector<Triangle>& triangles);

  std::size_t wall_size() const { return wall_; }
  std::size_t node_slots() const { return nodes_.size(); }
  bool interior(std::uint32_t i) const { return i >= wall_; }
  bool alive(std::uint32_t i) const { return at_[i] != kNone; }
  const Vec2& at(std::uint32_t i) const { return nodes_[i]; }
  void move(std::uint32_t i, const Vec2& p) { nodes_[i] = p; }
  double size(std::uint32_t i) const { return sizes_[i]; }
  void set_size(std::uint32_t i, double size) { sizes_[i] = size; }
  const std::vector<Cell>& cells() const { return cells_; }
  bool cell_alive(std::size_t c) const { return cells_[c].node[0] != cells_[c].node[1]; }
  int valence(std::uint32_t i) const;
  /// The node across the edge opposite to corner k; there must be a neighbour.
  std::uint32_t opposite(std::int32_t cell, int k) const {
    const Cell& other = cells_[cells_[cell].next[k]];
    return other.node[side(other, cell)];
  }

  /// Calls visit(b, c) for every triangle (i, b, c) at node i, counter-clockwise; each ring node of an interior node is
  /// `b` once.
  template <class Visit>
  void star(std::uint32_t i, Visit&& visit) const {
    const std::int32_t first = at_[i];
    std::int32_t c = first;
    do {
      const Cell& cell = cells_[c];
      const int k = corner(cell, i);
      visit(cell.node[(k + 1) % 3], cell.node[(k + 2) % 3]);
      c = cell.next[(k + 1) % 3];
    } while (c != first && c != kNone);
  }
  /// The cells at node i, counter-clockwise.
  template <class Visit>
  void cells_at(std::uint32_t i, Visit&& visit) const {
    const std::int32_t first = at_[i];
    std::int32_t c = first;
    do {
      visit(c);
      const Cell& cell = cells_[c];
      c = cell.next[(corner(cell, i) + 1) % 3];
    } while (c != first && c != kNone);
  }

  /// The cells at the nodes, each once.
  std::vector<std::int32_t> cells_of(const std::vector<std::uint32_t>& nodes) const;

  /// Flips edges of the cells until every one of them is Delaunay, and those that the flips touched; returns the flips.
  int legalise(const std::vector<std::int32_t>& cells);
  int legalise(std::uint32_t node);
  /// A node in the middle of the edge opposite to corner k of the cell; kNone at the wall or when a half would be flat.
  std::int32_t split(std::int32_t cell, int k);
  /// Takes an interior node out and closes the gap; false (and nothing removed) where that cannot be done.
  bool remove(std::uint32_t i);

  /// Nodes that are left, wall first, in the order of their making.
  std::vector<Vec2> nodes() const;

 private:
  static int corner(const Cell& cell, std::uint32_t i) { return cell.node[0] == i ? 0 : (cell.node[1] == i ? 1 : 2); }
  static int side(const Cell& cell, std::int32_t neighbour) {
    return cell.next[0] == neighbour ? 0 : (cell.next[1] == neighbour ? 1 : 2);
  }
  double twice_area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  void hold(std::int32_t cell);
  void replace(std::int32_t cell, std::int32_t from, std::int32_t to);
  bool can_flip(std::int32_t cell, int k) const;
  bool is_delaunay(std::int32_t cell, int k) const;
  void flip(std::int32_t cell, int k);
  bool flip_illegal(std::int32_t cell);

  std::vector<Vec2> nodes_;
  std::vector<double> sizes_;
  std::size_t wall_;
  std::vector<Cell> cells_;
  std::vector<std::int32_t> at_;  ///< a cell at each node; at a wall node the first one counter-clockwise
  std::vector<std::int32_t> stack_;
};

}  // namespace vitrine::mesh_room
