// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>

namespace vitrine {

/// The print on a garment (CV_8UC1, 255), told from its cloth by colour: what the panel's border band does not show.
/// Empty where there is none, or where a pattern all over leaves no difference. `panel` marks the panel's own pixels,
/// `depth` [px] their distance to its border, `density` [px/m] the photo's scale.
cv::Mat find_print(const cv::Mat& rgb, const cv::Mat& panel, const cv::Mat& depth, double density);

}  // namespace vitrine
