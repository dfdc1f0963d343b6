// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "vitrine/model/garment_template.hpp"
#include "vitrine/model/image.hpp"
#include "vitrine/model/panel.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

struct FidelityOptions {
  int rows = 512;  ///< [px] height of the pictures that are compared, 64 to 4096
};

/// worn = shift + (width * flat.x, height * flat.y): from the front panel's metres to the mannequin's, seen from +Z.
struct FlatToWorn {
  double width = 1, height = 1;  ///< [-]
  Vec2 shift = Vec2::Zero();     ///< [m]
  Vec2 operator()(const Vec2& flat) const { return shift + Vec2(width * flat.x(), height * flat.y()); }
};

/// Where a named point of the photo lies, and where the dressed garment has it.
struct LandmarkMiss {
  std::string name;              ///< the template's feature, or "neck_low": the lowest point of the front neckline
  Vec2 flat = Vec2::Zero();      ///< [m] on the front panel, as in the photo
  Vec2 expected = Vec2::Zero();  ///< [m] the same as the fitted photo has it on the mannequin
  Vec2 worn = Vec2::Zero();      ///< [m] on the mannequin, x to the right and y up, seen from the front
  double miss_mm = 0;            ///< distance of the last two
};

/// How much a dressed garment looks like its photo.
struct Fidelity {
  double iou = 0;          ///< [-] width and height fitted apart, the camera level
  double iou_posed = 0;    ///< [-] the same with the photo posed as the mannequin: the figure that is held to a bar
  double camera_turn = 0;  ///< [rad] of `iou_posed`, within 6 degrees either way
  double leg_swing =
      0;  ///< [-] of `iou_posed`: by how much a metre of leg is moved outwards, on the photo, at most 0.5
  double iou_uniform = 0;    ///< [-] one scale fitted
  double iou_true_size = 0;  ///< [-] the panel's own metres, nothing but shifted
  FlatToWorn fit;            ///< of `iou`
  double uniform_scale = 1;  ///< [-] of `iou_uniform`
  std::vector<LandmarkMiss> landmarks;
  double landmark_mean_mm = 0, landmark_max_mm = 0;  ///< by the fit of `iou`, at the mannequin's scale
  /// The two silhouettes of `iou` in one frame, seen from the front: 0 or 255, one channel.
  Image photo, worn;
  double pixel = 0;                   ///< [m] of these two pictures
  Vec2 top_left = Vec2::Zero();       ///< [m] their corner on the mannequin
  std::vector<std::string> left_out;  ///< limbs that were cut off at their root line in both
};

/// Renders the garment at rest from the photo's camera (straight on the front, so far away that there is no
/// perspective; the cloth alone, as shops photograph on a mannequin that is then removed) and compares its silhouette
/// with the photo's.
///
/// What is compared. Sleeves lie on a board at angles of their own; they are cut off at their root line, in the photo
/// through the front panel, on the mannequin through each panel's cloth. Limbs that share a root (the legs of trousers
/// meet in the crotch) are what the garment consists of, and stay.
///
/// How it is laid over. A photo has no metres of its own, and cloth that goes around a body shows less of its width
/// than cloth on a board: 2/pi of it around a round body, some 0.7 to 0.85 around a trunk, while its length is seen in
/// full. Both are one figure for the whole garment, so `iou` fits one scale for the width and one for the height
/// besides the shift. `iou_posed` poses the photo as the mannequin, too: many garments lie or hang a little askew, so
/// the camera is turned; and legs lie as far apart as the photographer liked, so they are swung until their hems are as
/// far apart as the worn ones (sideways by a share of the depth below the crotch, so that no length changes). Nothing
/// else is fitted: no bending, no scale that changes with height. Everything by which a customer tells shapes apart
/// still counts: slope and width of the shoulders, neckline, waist, flare, hem line, length against width of each part.
/// `iou_uniform` and `iou_true_size` say what the two fits are worth: they fall where the photo's width had to go round
/// the body.
///
/// `labels`: the front photo's three labels in the front frame, as the panel's pixel_from_panel has it; the inside of
/// the back belongs to the silhouette in both. `pattern`, `positions`: the level that was draped, per panel and node
/// [m]. Deterministic. Errors (64): BAD_FIDELITY_OPTION; (65): NOTHING_TO_COMPARE (one of the two has no silhouette
/// left, or the arrays do not belong together).
Result<Fidelity> compare_with_photo(const Image& labels, const GarmentTemplate& garment, const Pattern& pattern,
                                    std::span<const std::vector<Vec3>> positions, const FidelityOptions& options = {});

/// Both silhouettes over each other, RGB: grey where they agree, blue where only the photo has cloth, orange where only
/// the dressed garment has; a line from each point of the photo (dot) to the garment's own.
Image draw_fidelity(const Fidelity& fidelity);

}  // namespace vitrine
