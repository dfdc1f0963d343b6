// SPDX-License-Identifier: GPL-3.0-or-later
// A second opinion on bodies and fields: CGAL measures what the mannequin room claims.
#pragma once
#include <string>
#include <vector>

#include "vitrine/mannequin.hpp"

namespace vitrine::bench {

struct BodyProbe {
  double height = 0, bust = 0, under_bust = 0, waist = 0, hip = 0, inside_leg = 0, arm = 0, neck_base = 0;  ///< [m]
  double fullest_hip = 0;  ///< [m] largest trunk girth from crotch to 0.56 of the height
  bool sound = false;      ///< closed, one piece, outward, finite
  bool crosses_itself = true;
  bool arms_free = false;     ///< bust section does not hold an arm
  double smallest_angle = 0;  ///< [degree] of any triangle's corner
  std::size_t triangles = 0;
};

/// Measures the mesh with CGAL's slicer and hull at the levels that the body names; lengths from the mesh alone, save
/// for the joints of the arm.
BodyProbe probe_body(const Mannequin& body);

struct FieldProbe {
  std::size_t points = 0, wrong_signs = 0;
  double within_half_mm = 0;             ///< [-] share
  double worst = 0;                      ///< [m]
  double exact_seconds = 0;              ///< computing every voxel of the field's grid by AABB queries
  std::size_t wrong_beyond_half_mm = 0;  ///< wrong signs further than 0.5 mm from the surface
  std::size_t wrong_voxel_signs = 0;     ///< among the voxels that were computed exactly
  double deepest_wrong_sign = 0;         ///< [m] from the surface
  double lookups_per_second = 0;         ///< with gradient; places along the surface, as a cloth's nodes lie
  double random_lookups_per_second = 0;  ///< places all over the body
};

/// The field against CGAL's AABB tree at random points within `band` [m] of the surface. `exact_share` of the grid's
/// slabs is computed exactly and scaled up, to time the alternative.
FieldProbe probe_field(const TriMesh& mesh, const DistanceField& field, std::size_t points, double band,
                       std::uint64_t seed, double exact_share);

}  // namespace vitrine::bench
