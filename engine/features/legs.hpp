// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>

#include "outline.hpp"
#include "vitrine/model/garment_template.hpp"

namespace vitrine::features_detail {

/// Whether a limb has a root on the middle line (a crotch), which it shares with its partner: a leg, not a sleeve.
bool is_leg(const GarmentTemplate& garment, const TemplateLimb& limb);
/// The feature where the legs meet, -1 when the garment has none.
int crotch_of(const GarmentTemplate& garment);
bool has_sleeves(const GarmentTemplate& garment);

struct LegCut {
  bool gap = false;      ///< ground is seen between the legs
  bool guessed = false;  ///< they lie on each other further up: the crotch was put where a body has it
};

/// Opens the gap between the legs up to the crotch: hems that touch are parted; a gap that closes like a needle's eye
/// is cut on to where its sides meet; where it ends far below any crotch the legs lie on each other, and it is cut on
/// to where the waist's width and a body's proportions put the crotch. The cut only follows the cloth's middle.
LegCut open_legs(cv::Mat& mask, const GarmentTemplate& garment);

/// [px] from `top` down to `bottom` of a body whose garment is `width` px wide between the scale rule's features; 0
/// when the proportions do not know their landmarks.
double expected_drop(const GarmentTemplate& garment, int top, int bottom, double width);

}  // namespace vitrine::features_detail
