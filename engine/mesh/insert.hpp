// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "boundary.hpp"
#include "lattice.hpp"
#include "sizing.hpp"
#include "wall.hpp"

namespace vitrine::mesh_room {

/// What nodes are put on.
struct Ground {
  const Boundary& boundary;
  const Wall& wall;
  const Sizing& sizing;
  /// Whether a node at p, where edges of `size` are asked for, is far enough from the wall to leave no flat triangle.
  bool is_clear(const Vec2& p, double size) const;
};

/// Interior nodes before they settle.
struct Inserted {
  std::vector<Vec2> ring;  ///< near the wall or in graded places: these will move
  std::vector<Vec2> rim;   ///< the neighbours of the ring; they stay
  std::vector<Vec2> deep;  ///< the rest, which lie where the repulsion's ground state has them already
};

/// Nodes on the lattice's sites, on lattices of half its step and so on where finer edges are asked for. Stops soon
/// after max_nodes; the caller refuses such a mesh. `depth` of the ring in target edges.
Inserted insert_nodes(const Ground& ground, const Lattice& lattice, double depth, std::size_t max_nodes);

}  // namespace vitrine::mesh_room
