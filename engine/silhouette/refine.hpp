// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>

#include "picture.hpp"

namespace vitrine {

constexpr int contour_reach = 2;  ///< [px of the rough mask] how far its contour may be off

/// How much of each pixel of `rgb` the garment covers (CV_8U, 0..255), from the roughly right mask of the same picture
/// at `rough`'s size (not larger): the contour moves onto the colour change beside it. Within about two rough pixels of
/// the contour a pixel is covered as far as its colour has come from the ground's local mean to the garment's; where
/// both look alike, or on one side nothing is sure, the contour stays where it was. `sides` are those of `rough`.
cv::Mat refine_contour(const cv::Mat& rgb, const cv::Mat& rough, const Sides& sides);

}  // namespace vitrine
