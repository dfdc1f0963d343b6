// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "boundary.hpp"
#include "wall.hpp"

namespace vitrine::mesh_room {

/// A hexagonal lattice, the ground state of a repulsion with a finite range: nodes at
/// origin + j * step * axis + k * step * (axis turned by 60 degrees).
struct Lattice {
  Vec2 origin = Vec2::Zero();
  double angle = 0;  ///< [rad] of the axis, in [0, pi/3)
  double step = 0;   ///< [m]
};

/// The lattice of that step whose sites come closest to the boundary's own nodes. A panel that is symmetric about an
/// upright middle gets a symmetric lattice.
Lattice fit_lattice(const Boundary& boundary, double step);

/// The lattice's sites on the cloth that are at least `clearance` [m] from the wall, row by row.
std::vector<Vec2> insert_nodes(const Boundary& boundary, const Wall& wall, const Lattice& lattice, double clearance);

}  // namespace vitrine::mesh_room
