// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>

namespace vitrine {

/// Replaces the pixels of `hole` (CV_8UC1, non-zero) by cloth from elsewhere in the picture: block by block from the
/// hole's border inwards, each a copy of that place among the `cloth` pixels whose surroundings differ least from the
/// block's own (of `known` pixels) but for a steady step, and the step, a membrane between the borders, is added. So
/// stripes run on and light falls off as it did. Returns what could not be filled because no block of cloth was large
/// enough.
cv::Mat fill_with_cloth(cv::Mat& rgb, const cv::Mat& hole, const cv::Mat& known, const cv::Mat& cloth);

}  // namespace vitrine
