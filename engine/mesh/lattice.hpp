// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "boundary.hpp"

namespace vitrine::mesh_room {

/// A hexagonal lattice, the ground state of a repulsion with a finite range: rows along `axis`, 0.866 steps apart,
/// every row half a step on.
struct Lattice {
  Vec2 origin = Vec2::Zero();
  Vec2 axis = Vec2::UnitX();  ///< unit vector
  double step = 0;            ///< [m]
};

/// The lattice of that step whose sites come closest to the boundary's own nodes.
Lattice fit_lattice(const Boundary& boundary, double step);

}  // namespace vitrine::mesh_room
