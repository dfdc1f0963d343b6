// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>

namespace vitrine {

/// Moves the contour of a roughly right mask onto the colour change beside it, at the picture's own resolution: each
/// pixel within `reach` of the contour goes to the side whose local mean colour it is closer to. Where both sides look
/// alike the contour stays where it was.
cv::Mat refine_contour(const cv::Mat& rgb, const cv::Mat& mask, int reach);

}  // namespace vitrine
