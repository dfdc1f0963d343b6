// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>

#include "vitrine/model/geometry.hpp"

namespace vitrine::body {

/// Zero surface of `field` (negative inside) in the box, as a closed 2-manifold, triangles outward. The box must hold
/// the whole surface. `slack` [m]: cells are skipped in blocks whose centre is further from the surface than the
/// block's half diagonal times 1.6 plus this, so the field has to be roughly metric.
TriMesh march(const std::function<double(const Vec3&)>& field, const Vec3& low, const Vec3& high, double spacing,
              double slack = 0.03);

}  // namespace vitrine::body
