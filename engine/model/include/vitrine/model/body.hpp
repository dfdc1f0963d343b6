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
  /// crotch, thigh_left/right (middle of the thigh, 2 cm below the crotch), knee_left/right, ankle_left/right, crown.
  std::map<std::string, Vec3> landmarks;
  /// Girths measured on the mesh [m]: bust, under_bust, waist, hip, neck_base, biceps, wrist, thigh; and height,
  /// inside_leg, arm.
  std::map<std::string, double> girths;
  std::string source;                 ///< "built-in woman", or the file's name
  std::vector<std::string> warnings;  ///< unusual measurements; what an import had to guess
};

/// Point of the triangle a b c nearest to p.
Vec3 nearest_point(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// The body's triangles, listed for each grid cell that its surface passes: interpolation between voxels errs by a
/// share of a millimetre, which is enough to be wrong about the side of a point that lies closer to the surface than
/// that.
struct SurfacePatches {
  struct Facet {
    Vec3 a = Vec3::Zero();                                      ///< [m] first corner
    Eigen::Vector3f ab{0, 0, 0}, ac{0, 0, 0}, normal{0, 0, 0};  ///< the others from there [m]; outward, unit
  };
  /// Up to a cell's reach the triangles alone count, from this many times the reach the interpolation alone.
  static constexpr float fade = 1.3F;
  /// Cells come in bricks of 4 x 4 x 4, x fastest; only bricks that the surface passes are kept.
  std::array<int, 3> bricks{0, 0, 0};
  std::vector<std::int32_t> brick;  ///< number of each brick's first cell, or -1; x fastest
  /// By how much interpolation in each cell may err, in shares of `most`; 0: the surface is not here, or flat. Bytes,
  /// so that most lookups end in the processor's cache.
  std::vector<std::uint8_t> reach;
  float most = 0;                    ///< [m]
  std::vector<std::uint32_t> first;  ///< of each cell's list in `facet`; the next one ends it
  std::vector<std::uint32_t> facet;
  std::vector<Facet> facets;
  bool overlaps = false;  ///< the mesh cuts through itself: cells whose triangles lie inside the body were left out

  /// Number of the cell at these grid coordinates, -1 where nothing is kept.
  std::int32_t cell(const std::array<int, 3>& c) const {
    const std::size_t row = static_cast<std::size_t>(c[1] >> 2) + static_cast<std::size_t>(bricks[1]) * (c[2] >> 2);
    const std::int32_t start = brick[static_cast<std::size_t>(c[0] >> 2) + static_cast<std::size_t>(bricks[0]) * row];
    return start < 0 ? -1 : start + ((c[0] & 3) | (c[1] & 3) << 2 | (c[2] & 3) << 4);
  }
  float reach_of(std::int32_t cell) const {
    return most / 255 * static_cast<float>(reach[static_cast<std::size_t>(cell)]);
  }
  /// Signed distance [m] of p to the nearest of a cell's triangles.
  double distance(const Vec3& p, std::int32_t cell) const;
};

/// Signed distance to the body on a regular grid of voxels (paper III.C): negative inside, metres.
/// Cheap to sample, safe outside the grid (the distance to the grid's box is added).
struct DistanceField {
  Vec3 origin = Vec3::Zero();  ///< position of sample (0,0,0)
  double spacing = 0.005;      ///< [m] voxel edge
  std::array<int, 3> size{0, 0, 0};
  std::vector<float> values;  ///< [m], x fastest, then y, then z
  SurfacePatches patches;     ///< may be empty: then everything is interpolated

  /// Distance at p [m]: trilinear or, where that may err on the sign, that to the triangles themselves.
  double distance(const Vec3& p) const;
  /// Distance and its gradient (that of the interpolation throughout, which is smoother than the triangles are; not
  /// normalised; zero-length only at singular points) at p.
  double distance(const Vec3& p, Vec3& gradient) const;

 private:
  double near_surface(const Vec3& p, const std::array<int, 3>& cell, double interpolated) const;
};

}  // namespace vitrine
