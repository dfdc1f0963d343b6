// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "vitrine/model/garment.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

/// What the subject stands on: a seamless sweep of light grey, or nothing, with the shadow in the alpha channel.
enum class Ground { studio, alpha };

struct SubjectBox {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< [m]
};

struct PreviewOptions {
  std::vector<double> turns_deg{0, 35, 180};  ///< [degree] the views, side by side: front, three-quarter, back
  int view_width = 480;                       ///< [px] of one view
  int view_height = 720;                      ///< [px]
  int samples = 4;                            ///< antialiasing rays per pixel
  int occlusion_rays = 12;                    ///< per lighting point; there is one for each four pixels
  double frame_bottom = -1, frame_top = -1;   ///< [m] vertical extent shown; both < 0 = the subject's own
  std::optional<SubjectBox> subject = {};  ///< what the camera is set up for: the body, to keep it still over a whole
                                           ///< catalogue; without it the meshes
  Ground ground = Ground::studio;
};

/// A lit picture of the views side by side: soft key light and ambient occlusion by Embree rays; the same input gives
/// the same bytes. RGB before the studio's ground, RGBA (not premultiplied) without it. Errors (64):
/// BAD_PREVIEW_OPTIONS; (70): BAD_MESH.
Result<Image> render_preview(std::span<const RenderMesh> meshes, const PreviewOptions& options = {});

/// Turns of a turntable of `count` views, the first from the front.
std::vector<double> turntable(int count);

/// The frame of a close view: 0.46 m below and a little above the top of a mesh; {bottom, top} in metres.
std::array<double, 2> detail_frame(const RenderMesh& mesh);

}  // namespace vitrine
