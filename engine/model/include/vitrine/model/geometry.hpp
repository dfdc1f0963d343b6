// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace vitrine {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Triangle = std::array<std::uint32_t, 3>;

/// A triangle mesh in space: metres, +Y up, +Z front, triangles counter-clockwise seen from outside.
struct TriMesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

/// q = origin + x * axis_x + y * axis_y: takes panel metres to photo pixels (or back, see inverse()).
struct Affine2 {
  Vec2 origin = Vec2::Zero();
  Vec2 axis_x = Vec2::UnitX();
  Vec2 axis_y = Vec2::UnitY();
  Vec2 operator()(const Vec2& p) const { return origin + p.x() * axis_x + p.y() * axis_y; }
  Affine2 inverse() const {
    const double det = axis_x.x() * axis_y.y() - axis_x.y() * axis_y.x();
    Affine2 r;
    r.axis_x = Vec2(axis_y.y(), -axis_x.y()) / det;
    r.axis_y = Vec2(-axis_y.x(), axis_x.x()) / det;
    r.origin = -(origin.x() * r.axis_x + origin.y() * r.axis_y);
    return r;
  }
};

}  // namespace vitrine
