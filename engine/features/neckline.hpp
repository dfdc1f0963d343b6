// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "outline.hpp"

namespace vitrine::features_detail {

/// The front neckline seen below the inside of the back.
struct NeckPath {
  bool found = false;
  std::vector<Vec2> path;  ///< [px] from neck_left to neck_right
  double evidence = 0;     ///< [-] 0..1 how much of it lies on an edge of one polarity
};

/// Looks for the front neckline inside the silhouette below its own top edge. `top` is the silhouette's outline from
/// neck_left to neck_right. `shape` is the neckline the user named, or null.
NeckPath find_front_neckline(const Image& rgb, const cv::Mat& mask, const std::vector<Vec2>& top,
                             const NecklineTemplate* shape);

/// Paper Fig. 2: the rectangle spanned by both neck points and the lowest point between them, in the upright frame of
/// the garment; foreground / background pixels in it. `low` is that lowest point.
double neck_ratio(const cv::Mat& panel, const std::vector<Vec2>& neck_edge, double tilt_deg, Vec2& low);

/// Neckline whose ratio range holds `ratio`, else the one with the nearest range. `necklines` is not empty.
int choose_neckline(std::span<const NecklineTemplate> necklines, double ratio);

}  // namespace vitrine::features_detail
