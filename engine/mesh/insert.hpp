// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "boundary.hpp"
#include "lattice.hpp"
#include "sizing.hpp"
#include "wall.hpp"

namespace vitrine::mesh_room {

/// Interior nodes before they settle: `ring` those near the wall or in graded places, which will move; `deep` the rest,
/// which lie where the repulsion's ground state has them already.
struct Inserted {
  std::vector<Vec2> ring, deep;
};

/// Nodes on the lattice's sites, on lattices of half its step and so on where finer edges are asked for. Sites within
/// `depth` edges of the wall go to the ring. Stops soon after max_nodes;
/// the caller refuses such a mesh.
Inserted insert_nodes(const Boundary& boundary, const Wall& wall, const Sizing& sizing, const Lattice& lattice,
                      double depth, std::size_t max_nodes);

}  // namespace vitrine::mesh_room
