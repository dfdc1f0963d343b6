// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>
#include <string>

#include "picture.hpp"

namespace vitrine {

/// Outcome of the paper's own method (III.A).
struct Scan {
  cv::Mat mask;       ///< CV_8U 0/255: between the first and last edge pixel of its row and of its column, without
                      ///< the pockets of board colour
  cv::Mat painted;    ///< the photo with the ground painted in the unused colour
  cv::Vec3b unused;   ///< a colour that the photo does not show
  double second = 0;  ///< area of the next largest piece as a share of the garment
  std::string doubt;  ///< empty when the result can be trusted
};

Scan scan_edges(const WorkPicture& work);

/// Zhang and Suen's thinning: edges of one pixel width.
cv::Mat thin_edges(const cv::Mat& edges);

/// A colour that occurs nowhere in the picture.
cv::Vec3b unused_colour(const cv::Mat& rgb);

}  // namespace vitrine
