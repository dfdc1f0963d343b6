// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "outline.hpp"

namespace vitrine::features_detail {

/// The front neckline seen below the inside of the back.
struct NeckPath {
  bool found = false;
  bool expected_none = false;  ///< the silhouette's own top edge is as deep as a front neckline
  std::vector<Vec2> path;      ///< [px] from neck_left to neck_right
  double evidence = 0;         ///< [-] 0..1 how much of it lies on an edge of one polarity
};

/// Looks for the front neckline inside the silhouette below its own top edge. `top` is the silhouette's outline from
/// neck_left to neck_right. `shape` is the neckline the user named, or null.
NeckPath find_front_neckline(const Image& rgb, const cv::Mat& mask, const std::vector<Vec2>& top,
                             const NecklineTemplate* shape);

/// Neck points that were taken on the shoulder line or on a label move to the corner where the neckline begins. `place`
/// holds the features' places on the outline's chain.
void settle_neck_points(const Outline& outline, const GarmentTemplate& garment, double tilt_deg,
                        std::vector<int>& place);

/// Paper Fig. 2: the rectangle spanned by both neck points and the lowest point between them, turned with the line of
/// the neck points; foreground / background pixels in it. `low` is that lowest point.
double neck_ratio(const cv::Mat& panel, const std::vector<Vec2>& neck_edge, Vec2& low);

/// How pointed a neckline is at its lowest point: its slope there over its mean slope. 1 for a V, under a half for a
/// half ellipse, 0 for a square neck. `edge` runs from neck point to neck point.
double tip_sharpness(const std::vector<Vec2>& edge);

/// The ratio to choose by: in a neckline much shallower than wide (a back's) a pixel of roughness moves the ratio
/// across its whole range, so that it is drawn to that of a plain arc (a half ellipse).
double choice_ratio(double ratio, const std::vector<Vec2>& edge);

/// Neckline whose ratio range holds `ratio`, else the one with the nearest range; close to the border of two ranges the
/// one whose profile is as pointed as the photo's neckline; of two whose ranges overlap the one that is as deep as the
/// photo's. `depth` [-] is the depth over the width, 0 where it was not seen. `necklines` is not empty.
int choose_neckline(std::span<const NecklineTemplate> necklines, double ratio, double sharpness, double depth);

/// Depth of a neckline over its width [-]. `edge` runs from neck point to neck point.
double relative_depth(const std::vector<Vec2>& edge);

}  // namespace vitrine::features_detail
