// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <string>
#include <vector>

#include "vitrine/model/geometry.hpp"

namespace vitrine {

/// A mannequin: closed mesh standing on y = 0, facing +Z, centred on x = 0; metres.
struct Mannequin {
  TriMesh mesh;
  /// Body landmarks (Table I). "left" is the left of the front view, x < 0. Always present: neck_left, neck_right (side
  /// of the neck base), neck_front, neck_back, shoulder_left/right (acromion), armpit_left/right, bust_left/right,
  /// under_bust, waist, waist_left/right, hip, hip_left/right, biceps_left/right, elbow_left/right, wrist_left/right,
  /// crotch, knee_left/right, ankle_left/right, crown.
  std::map<std::string, Vec3> landmarks;
  /// Girths measured on the mesh [m]: bust, under_bust, waist, hip, neck_base, biceps, wrist, thigh; and height,
  /// inside_leg, arm.
  std::map<std::string, double> girths;
  std::string source;                 ///< "built-in woman", or the file's name
  std::vector<std::string> warnings;  ///< unusual measurements; what an import had to guess
};

/// Signed distance to the body on a regular grid of voxels (paper III.C): negative inside, metres.
/// Cheap to sample, safe outside the grid (the distance to the grid's box is added).
struct DistanceField {
  Vec3 origin = Vec3::Zero();  ///< position of sample (0,0,0)
  double spacing = 0.005;      ///< [m] voxel edge
  std::array<int, 3> size{0, 0, 0};
  std::vector<float> values;  ///< [m], x fastest, then y, then z

  /// Trilinear distance at p [m].
  double distance(const Vec3& p) const;
  /// Distance and its gradient (not normalised; zero-length only at singular points) at p.
  double distance(const Vec3& p, Vec3& gradient) const;
};

}  // namespace vitrine
