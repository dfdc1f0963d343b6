// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "vitrine/model/garment.hpp"
#include "vitrine/model/panel.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

struct TextureOptions {
  int max_size = 2048;  ///< [px] of the atlas; the smallest power of two that carries the photos, 512 at least
  int gutter = 8;       ///< [px] between the panels, at 1,024
  int top_value = 240;  ///< [-] brightest base colour
};

/// One panel's picture: the photo in the front frame, its three labels, and the flat panel that maps into it.
struct TextureSource {
  const Image* rgb = nullptr;     ///< photo
  const Image* labels = nullptr;  ///< Label values, same size
  const Panel* panel = nullptr;
  const PanelMesh* mesh = nullptr;
};

struct Atlas {
  Image rgb;                          ///< square or 2:1, power of two
  std::vector<std::vector<Vec2>> uv;  ///< per panel, per node; (0,0) top left
};

/// Front and back photo side by side in one power-of-two picture; colours bled outwards past the outline so that no
/// board shows at a seam; labels other than outside never reach it. Pixels of the panel's outer face are kept as they
/// are, but for a rim of 2 px where they are mixed with the board or lie in its shadow, a mild gain of the back photo
/// where the two were lit differently, and the top value. The front lies on the left; integer photo coordinates are
/// pixel centres. Errors (64): BAD_TEXTURE_OPTIONS; (65): NO_TEXTURE (a panel without a garment pixel),
/// TEXTURE_TOO_SMALL; (70): BAD_TEXTURE_SOURCE.
Result<Atlas> make_atlas(std::span<const TextureSource> panels, const TextureOptions& options = {});

/// The draped panels as one mesh: split at texture cuts, smooth normals over sewn seams, outward winding on both sides.
/// An empty mesh where the arguments contradict each other in size; the writers refuse it.
RenderMesh assemble_garment(const Pattern& pattern, const std::vector<std::vector<Vec3>>& positions,
                            const std::vector<std::vector<std::uint32_t>>& welded, Atlas atlas);

/// The mannequin in a neutral matte colour.
RenderMesh assemble_mannequin(const TriMesh& body);

}  // namespace vitrine
