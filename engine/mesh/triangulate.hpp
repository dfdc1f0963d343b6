// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "boundary.hpp"

namespace vitrine::mesh_room {

/// Whether the closed polygon neither touches nor crosses itself (exact predicates).
bool is_simple_polygon(std::span<const Vec2> outline);

/// Constrained Delaunay triangulation of the nodes, the first of which are the boundary in order, without
/// the triangles outside the cloth. Counter-clockwise, the smallest index first, sorted: the result does not depend
/// on the order in which CGAL stores its faces. Empty when the nodes do not allow it (a node on a constraint).
std::vector<Triangle> triangulate(std::span<const Vec2> nodes, const Boundary& boundary);

}  // namespace vitrine::mesh_room
