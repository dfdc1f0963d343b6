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

}  // namespace vitrine::mesh_room
