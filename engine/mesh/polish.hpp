// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <vector>

#include "vitrine/model/geometry.hpp"
#include "wall.hpp"

namespace vitrine::mesh_room {

/// Moves the interior nodes around badly shaped triangles to where the worst triangle at the node becomes better; no
/// move makes the worst triangle of a node worse. Triangles stay as they are joined. Returns the number of moves.
int polish(std::vector<Vec2>& nodes, std::size_t outline_size, const std::vector<Triangle>& triangles, const Wall& wall,
           double edge_length);

}  // namespace vitrine::mesh_room
