// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <vector>

#include "vitrine/model/geometry.hpp"
#include "wall.hpp"

namespace vitrine::mesh_room {

/// One round of the paper's edge-ratio rules and of the merging of close neighbours. Nodes before `outline_size` stay;
/// each neighbourhood is touched once a round, the flattest triangles first. Returns the number of changes.
int apply_edge_ratio_rules(std::vector<Vec2>& nodes, std::size_t outline_size, const std::vector<Triangle>& triangles,
                           const Wall& wall, double edge_length, std::size_t max_nodes);

}  // namespace vitrine::mesh_room
