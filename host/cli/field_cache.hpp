// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "vitrine/mannequin.hpp"

namespace vitrine::cli {

/// The body's voxels from `folder`, where an earlier run left them under the mesh's and the options' hash, or worked
/// out and left there; an empty folder's name means no cache. A damaged file is worked out again. The folder is kept
/// below 1 GB: what was not used for longest goes. Errors: those of voxelise, and 73 if the folder cannot be written.
Result<DistanceField> cached_field(const TriMesh& mesh, const VoxelOptions& options, const std::string& folder);

}  // namespace vitrine::cli
