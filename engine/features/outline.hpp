// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>
#include <vector>

#include "vitrine/features.hpp"

namespace vitrine::features_detail {

/// One sample of the smoothed outline; samples are `step` pixels of arc apart.
struct Sample {
  Vec2 at = Vec2::Zero();  ///< [px] on the smoothed chain
  int chain = 0;           ///< its pixel of the chain code
  double turn_deg = 0;     ///< signed, > 0 convex; the stronger of a fine and a coarse arc
  double coarse_deg = 0;   ///< signed, over the coarse arc only
  int candidate = -1;      ///< index into Outline::candidates, or -1
};

/// The 4-connected outline of a mask with everything the matcher asks of it. Clockwise in the picture.
struct Outline {
  std::vector<Vec2> chain;  ///< [px] every pixel of the chain code
  std::vector<Sample> samples;
  std::vector<Candidate> candidates;  ///< contour_index is the place on `chain`
  double step = 1;                    ///< [px] arc between samples
  double diagonal = 1;                ///< [px] of the bounding box
  cv::Rect box;
};

/// Largest 4-connected piece of `mask` (CV_8U, non-zero = garment) without hairs thinner than `hair` pixels.
cv::Mat clean_mask(const cv::Mat& mask, int hair);

/// Paper III.A: original minus its 3x3 erosion, walked as a chain code; one candidate per run of high turn. Empty chain
/// when the mask has no walkable outline.
Outline trace_outline(const cv::Mat& mask, const FeatureOptions& options);

/// Shoelace area [px^2], positive when clockwise in the picture (y down).
double signed_area(const std::vector<Vec2>& polygon);

/// True when no two edges that are not neighbours touch.
bool is_simple(const std::vector<Vec2>& polygon);

/// Closed Gaussian smoothing; entries with pinned[i] stay where they are and are not smoothed across.
std::vector<Vec2> smooth_closed(const std::vector<Vec2>& points, double sigma, const std::vector<char>& pinned);

}  // namespace vitrine::features_detail
