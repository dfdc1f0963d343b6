// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "evidence.hpp"
#include "outline.hpp"
#include "vitrine/model/garment_template.hpp"

namespace vitrine::features_detail {

/// One feature on the outline.
struct Placed {
  int sample = 0;
  bool snapped = false;   ///< on a candidate
  double confidence = 0;  ///< [-] 0..1
};

struct Match {
  std::vector<Placed> features;  ///< in the template's order
  int pose = -1;
  double tilt_deg = 0;  ///< start rotation that explained the outline best
  double cost = 1e30;   ///< lower is better; compares poses
  double score = 0;     ///< [-] 0..1
  Evidence evidence;    ///< what the score is made of
};

/// Feature indices in the order in which the outline meets them, walked clockwise.
std::vector<int> outline_order(const GarmentTemplate& garment);

/// Fits every pose at several tilts and keeps the best one.
Match match_template(const Outline& outline, const cv::Mat& mask, const GarmentTemplate& garment);

/// Tilt from the pairs of partners [degree], clockwise positive: how far the garment is turned in the picture.
double tilt_of(const std::vector<Vec2>& points, const GarmentTemplate& garment, double fallback_deg);

}  // namespace vitrine::features_detail
