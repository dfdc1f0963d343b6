// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <vector>

#include "insert.hpp"
#include "sheet.hpp"

namespace vitrine::mesh_room {

/// One round of the paper's edge-ratio rules and of the merging of close neighbours over the triangles that have a wall
/// or ring node, the flattest first; each neighbourhood is touched once a round. Nodes taken out leave the ring, new
/// ones join it. Returns the number of changes.
int apply_edge_ratio_rules(Sheet& sheet, const Ground& ground, std::vector<std::uint32_t>& ring);

/// In sharp corners and slits of the outline, where no lattice site has room: a triangle with an angle below 20 degrees
/// and its neighbour across its long edge get a node in their middle where that makes the smallest angle larger. New
/// nodes join the ring.
void relieve_sharp_triangles(Sheet& sheet, std::vector<std::uint32_t>& ring);

}  // namespace vitrine::mesh_room
