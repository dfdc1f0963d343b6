// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "vitrine/model/body.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

/// The paper's eight measurements [m].
struct Measurements {
  std::string sex = "woman";  ///< "woman" or "man"
  double height = 1.720;
  double bust = 0.880;
  double under_bust = 0.750;
  double waist = 0.680;
  double hip = 0.940;
  double inside_leg = 0.815;
  double arm = 0.575;  ///< shoulder point to wrist
  double neck_base = 0.365;
};

/// Shop sizes: "woman-" or "man-" with xs, s, m, l, xl, xxl. Error: UNKNOWN_PRESET (64).
Result<Measurements> preset_measurements(const std::string& name);

/// One sentence for every measurement, difference or share of the height that lies outside 1-99 % of the ANSUR II
/// survey: such a body can be built, but it may be a slip of the pen.
std::vector<std::string> unusual_measurements(const Measurements& measurements);

struct VoxelOptions {
  double spacing = 0.006;  ///< [m] voxel edge
  double margin = 0.08;    ///< [m] kept free around the body
};

/// Built-in parametric body. Errors: IMPLAUSIBLE_MEASUREMENTS (65) naming the measurement and the range that would
/// work.
Result<Mannequin> build_mannequin(const Measurements& measurements);

/// Any watertight OBJ, GLB, PLY or DAE, front towards +Z (or standing along +Z, front towards -Y). Metres; a height of
/// 140-220 is taken for centimetres, 1400-2200 for millimetres, 55-87 for inches; feet that point to the back turn it
/// around. What was guessed is in `warnings`. Landmarks and girths
/// are found on the mesh. Errors: MISSING_FILE (66); NOT_A_MESH, NOT_WATERTIGHT, NOT_A_BODY, TOO_LARGE (65).
Result<Mannequin> import_mannequin(const std::string& path);

/// Signed distance on voxels around the body (paper III.C): exact up to three voxels from the surface, beyond that
/// interpolated between exact distances four voxels apart. Signs are exact up to 400,000 triangles; with more they are
/// the interpolation's. Errors: NOT_WATERTIGHT, TOO_LARGE (65), BAD_OPTION (64).
Result<DistanceField> voxelise(const TriMesh& body, const VoxelOptions& options = {});

/// What `voxelise` puts into `patches`, for a field whose values were kept somewhere. `overlaps`: as it was in the
/// field's patches.
SurfacePatches find_patches(const TriMesh& body, const DistanceField& field, bool overlaps);

}  // namespace vitrine
