// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "vitrine/model/body.hpp"
#include "vitrine/model/garment_template.hpp"
#include "vitrine/model/image.hpp"

namespace vitrine {

/// A photo drawn from a template alone, and where its features are in it.
struct TemplatePhoto {
  Image rgb;
  std::vector<Vec2> features;  ///< [px] per template feature, in the front frame
  double diagonal = 0;         ///< [px] of the garment's box
};

/// Height over width of a pose's box on this body: the scale rule says how wide the garment is, and the landmarks next
/// below the anchors how long that makes it. A template has no proportions of its own.
double box_proportions(const GarmentTemplate& garment, const TemplatePose& pose, const Mannequin& body);

/// The pose as a plain garment on a plain board. Along the neck edge, where the garment has one, the front shows the
/// neckline (null: none, a straight edge) and behind it the inside of the back. A back photo is mirrored, as cameras
/// see it. Seed 0 draws the pose as it is; others move every corner by up to a tenth of its search radius and choose
/// other colours.
TemplatePhoto draw_template_photo(const GarmentTemplate& garment, const TemplatePose& pose,
                                  const NecklineTemplate* neckline, Side side, double proportions, unsigned seed);

}  // namespace vitrine
