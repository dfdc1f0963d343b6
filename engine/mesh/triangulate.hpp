// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "vitrine/model/geometry.hpp"

namespace vitrine::mesh_room {

/// Whether the closed polygon neither touches nor crosses itself (exact predicates).
bool is_simple_polygon(std::span<const Vec2> outline);

/// Constrained Delaunay triangulation of the nodes, the first `outline_size` of which are the outline in order, without
/// the triangles outside the outline. Counter-clockwise, the smallest index first, sorted: the result does not depend
/// on the order in which CGAL stores its faces. Empty when the nodes do not allow it (a node on a constraint).
std::vector<Triangle> triangulate(std::span<const Vec2> nodes, std::size_t outline_size);

}  // namespace vitrine::mesh_room
