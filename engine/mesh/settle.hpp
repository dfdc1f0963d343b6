// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <vector>

#include "sheet.hpp"

namespace vitrine::mesh_room {

/// Lets the nodes repel each other until they rest; flips keep the sheet Delaunay. Returns the sweeps used.
int settle(Sheet& sheet, const std::vector<std::uint32_t>& ring, int sweeps);

/// Moves the nodes of badly shaped triangles to where the sum of what is wrong around them is least.
void polish(Sheet& sheet, const std::vector<std::uint32_t>& ring, int rounds);

}  // namespace vitrine::mesh_room
