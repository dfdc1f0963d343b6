// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <vector>

#include "sheet.hpp"

namespace vitrine::mesh_room {

/// Moves the ring's nodes at badly shaped triangles (edge ratio below 1.6 or an angle below 38 degrees) to where what
/// is wrong around them is least in sum: few bad triangles rather than many middling ones. Flips keep the sheet
/// Delaunay.
void polish(Sheet& sheet, const std::vector<std::uint32_t>& ring);

}  // namespace vitrine::mesh_room
