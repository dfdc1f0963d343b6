// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <vector>

#include "sheet.hpp"

namespace vitrine::mesh_room {

/// Lets the ring's nodes repel each other, the wall repels them too, until they rest or the sweeps are used up; flips
/// keep the sheet Delaunay. The force is the paper's eq. (1) let down to zero at its range R = 1.1 edges,
/// F = G (1/r^2 - 1/(R r)), between nodes that an edge joins: with six neighbours around it, a node feels nothing else,
/// and where neighbours are too far apart they are drawn together. Returns the sweeps used.
int settle(Sheet& sheet, const std::vector<std::uint32_t>& ring, int sweeps);

}  // namespace vitrine::mesh_room
