// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "vitrine/model/geometry.hpp"

namespace vitrine::body {

/// One closed curve of a plane section of a closed mesh.
struct Ring {
  std::vector<Vec3> points;
  Vec3 centre = Vec3::Zero();  ///< centroid of the enclosed area
  double area = 0;             ///< [m^2]
  double tape = 0;             ///< [m] hull perimeter
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  bool holds(const Vec3& p) const;          ///< p, projected to the plane, is enclosed
  Vec3 u = Vec3::Zero(), v = Vec3::Zero();  ///< the plane's axes
};

/// Rings of the section through `point` with unit `normal`, largest area first.
std::vector<Ring> slice(const TriMesh& mesh, const Vec3& point, const Vec3& normal);

/// Same, keeping only triangles with a corner for which keep[vertex] is true (empty = all); open chains are dropped.
std::vector<Ring> slice(const TriMesh& mesh, const Vec3& point, const Vec3& normal, const std::vector<char>& keep);

}  // namespace vitrine::body
