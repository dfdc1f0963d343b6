// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "vitrine/model/garment.hpp"
#include "vitrine/model/panel.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

struct TextureOptions {
  int max_size = 2048;  ///< [px] of the atlas; the smallest power of two that carries the photos, 512 at least
  int gutter = 8;       ///< [px] between the panels, at 1,024
  /// [-] brightest base colour: brighter ones are eased below it, for shops that ask for 243; 255 leaves them alone.
  int top_value = 255;
};

/// One panel's picture: the photo in the front frame, its three labels, and the flat panel that maps into it.
struct TextureSource {
  const Image* rgb = nullptr;     ///< photo
  const Image* labels = nullptr;  ///< Label values, same size
  const Panel* panel = nullptr;
  const PanelMesh* mesh = nullptr;
  /// The photo is the front's and stands in for a back photo that the shop does not have: a print that can be told from
  /// the cloth is taken off, and the neckline's binding with the inside that it frames.
  bool borrowed = false;
};

/// What was done to a panel's picture.
struct TextureFigures {
  double print_share = 0;   ///< [-] of the panel: print taken off a borrowed photo
  double filled_share = 0;  ///< [-] of the panel: inside, label, print or board replaced by the panel's own cloth
  std::array<double, 3> gain{1, 1, 1};  ///< [-] of linear light; where front and back were lit differently
  double scale = 1;                     ///< [-] atlas pixels per photo pixel
};

struct Atlas {
  Image rgb;                           ///< sides are powers of two
  std::vector<std::vector<Vec2>> uv;   ///< per panel, per node; (0,0) top left
  std::vector<TextureFigures> panels;  ///< per panel
};

/// Front and back photo in one power-of-two picture, side by side or one above the other; colours bled outwards past
/// the outline so that no board shows at a seam; labels other than outside never reach it: larger places are filled
/// with the panel's own cloth. Pixels of the panel's outer face are kept as they are, but for a rim where they are
/// mixed with the board or lie in its shadow, a gain of the back photo where the two were lit differently, and the top
/// value. The front comes first; the back is turned round into the photo as it was taken, so that neither panel's
/// texture is inverted. Integer photo coordinates are pixel centres. Errors (64): BAD_TEXTURE_OPTIONS; (65): NO_TEXTURE
/// (a panel without a garment pixel), TEXTURE_TOO_SMALL; (70): BAD_TEXTURE_SOURCE.
Result<Atlas> make_atlas(std::span<const TextureSource> panels, const TextureOptions& options = {});

/// The draped panels as one mesh: split at texture cuts, smooth normals over sewn seams, outward winding on both sides.
/// An empty mesh where the arguments contradict each other in size; the writers refuse it.
RenderMesh assemble_garment(const Pattern& pattern, const std::vector<std::vector<Vec3>>& positions,
                            const std::vector<std::vector<std::uint32_t>>& welded, Atlas atlas);

/// The mannequin in a neutral matte colour.
RenderMesh assemble_mannequin(const TriMesh& body);

struct OcclusionOptions {
  /// [m] on the cloth that a texel of the occlusion picture may span; it is the texture halved as often as that allows.
  /// Light changes over a fold, and the mesh has no fold narrower than two of its edges (vitrine-texture-bench).
  double texel = 0.012;
  int rays = 32;        ///< [-] per texel, and half as many per vertex of the mannequin
  double reach = 0.25;  ///< [m] how far folds and limbs shade each other
};

/// Bakes how open the cloth's outer face lies to the sky, cosine-weighted, into garment.occlusion (255 = open), one
/// value for each texel, and into mannequin.shade, one for each vertex; by Embree rays against both. Viewers light
/// everything evenly, and folds read only by it. Same input, same bytes. Errors (64): BAD_OCCLUSION_OPTIONS.
std::optional<Error> bake_occlusion(RenderMesh& garment, RenderMesh& mannequin, const OcclusionOptions& options = {});

}  // namespace vitrine
