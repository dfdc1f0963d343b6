// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "vitrine/model/garment.hpp"

namespace vitrine {

/// The same mesh with its triangles in an order in which neighbours share vertices that were just used, and its
/// vertices in the order of that use (meshoptimizer); vertices that no triangle uses are left out. Pictures are not
/// copied.
RenderMesh ordered_for_caches(const RenderMesh& mesh);

}  // namespace vitrine
