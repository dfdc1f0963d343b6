// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cloth.hpp"

namespace vitrine::sewing {

/// Positions of a finer mesh of the same panel, read off the coarser one: each node's barycentric place in the coarse
/// rest shape (in the nearest triangle, extended past its border, where the finer outline bulges out).
std::vector<Vec3> prolong(const PanelMesh& coarse, const std::vector<Vec3>& positions, const PanelMesh& fine);

}  // namespace vitrine::sewing
