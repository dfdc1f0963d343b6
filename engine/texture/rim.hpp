// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>

namespace vitrine {

/// For every pixel the nearest non-zero pixel of `seeds` as an index (y * cols + x), and how far it is [px].
cv::Mat nearest_pixel(const cv::Mat& seeds, cv::Mat& distance);

/// Clears `keep` (CV_8UC1, non-zero: the garment's pixels) along the garment's border where board and garment are mixed
/// by lens, chroma subsampling or matting, and in the narrow shadow under the edge: sewn together they would draw a
/// line along every seam. `off` marks what is certainly not garment; `depth` is each pixel's distance to the border.
void drop_rim(const cv::Mat& rgb, const cv::Mat& depth, const cv::Mat& off, cv::Mat& keep);

/// Everything that is not kept takes the nearest kept colour from a little inside the border, blurred more the further
/// it lies. `whole` are the garment's pixels before the rim was dropped, or filled since; `depth` their distance to the
/// border.
void bleed(cv::Mat& rgb, const cv::Mat& keep, const cv::Mat& whole, const cv::Mat& depth);

}  // namespace vitrine
