// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>

#include "outline.hpp"
#include "vitrine/model/garment_template.hpp"

namespace vitrine::features_detail {

struct SleeveCuts {
  cv::Mat mask;          ///< without enclosed holes: opened towards the hem or filled
  int opened = 0;        ///< gaps between sleeve and body that were opened to the outer outline
  double gap_share = 0;  ///< [-] area of sleeve-like gaps / garment, for a garment that has no limbs
};

/// A sleeve whose cuff lies on the body leaves an enclosed gap. Opens each such gap along the sleeve's inner edge down
/// to the notch between cuff and hem; fills every other hole (loops of straps, holes of prints).
SleeveCuts open_sleeve_gaps(const cv::Mat& mask, const GarmentTemplate& garment, const FeatureOptions& options);

/// A sleeve that touches the body without any gap: cuts from where the template expects the armpit to the notch between
/// cuff and hem on that side (-1 left, +1 right). False, and nothing cut, when there is no such notch.
bool cut_hidden_gap(cv::Mat& mask, const Outline& outline, const Vec2& armpit, int side);

/// Cuts `mask` from `from` to `to`. The slit is wide enough for a simple outline.
void cut_slit(cv::Mat& mask, const Vec2& from, const Vec2& to, double diagonal);

}  // namespace vitrine::features_detail
