// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>

#include "vitrine/model/geometry.hpp"

namespace vitrine::body {

struct Surface {
  std::function<double(const Vec3&)> distance;  ///< [m]
  std::function<double(const Vec3&)> edge;      ///< [m] wanted edge length
};

/// Even triangles on the zero surface: short edges collapse, long ones split, valences are evened by flips, vertices
/// slide along the surface (Botsch & Kobbelt 2004). Keeps a closed 2-manifold closed: every step checks its link.
void remesh(TriMesh& mesh, const Surface& surface, int rounds);

/// Moves the vertices along their normals onto a surface that has changed a little; the triangles stay.
void settle(TriMesh& mesh, const Surface& surface);

}  // namespace vitrine::body
