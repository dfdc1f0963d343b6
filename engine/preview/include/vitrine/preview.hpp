// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "vitrine/model/garment.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

struct PreviewOptions {
  std::vector<double> turns_deg{0, 35, 180};  ///< [degree] the views, side by side: front, three-quarter, back
  int view_width = 480;                       ///< [px] of one view
  int view_height = 720;                      ///< [px]
  int samples = 4;                            ///< antialiasing rays per pixel
  int occlusion_rays = 8;                     ///< per sample
  double frame_bottom = -1, frame_top = -1;   ///< [m] vertical extent shown; both < 0 = the meshes' own extent
};

/// A lit picture of the views side by side: soft key light and ambient occlusion by Embree rays; the same
/// input gives the same bytes.
Result<Image> render_preview(std::span<const RenderMesh> meshes, const PreviewOptions& options = {});

}  // namespace vitrine
