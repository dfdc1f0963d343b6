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
  double second = 0;  ///< area of the next largest piece as a share of the garment
  std::string doubt;  ///< empty when the result can be trusted
};

Scan scan_edges(const WorkPicture& work);

/// Zhang and Suen's thinning: edges of one pixel width.
cv::Mat thin_edges(const cv::Mat& edges);

}  // namespace vitrine
