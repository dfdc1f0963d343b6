// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>
#include <vector>

#include "vitrine/model/image.hpp"

namespace vitrine {

/// OpenCV's view of an Image; the Image stays the owner.
cv::Mat view(const Image& image);

/// CIE L*a*b* of an RGB picture, CV_32FC3, L 0..100.
cv::Mat lab_from_rgb(const cv::Mat& rgb);

/// Largest Sobel 3x3 gradient over the three channels, CV_32F, in grey values (an ideal step of h gives 4 h).
cv::Mat sobel_magnitude(const cv::Mat& rgb);

/// Value below which `share` of the non-zero-masked pixels lie. `values` CV_32F, `mask` CV_8U.
float percentile(const cv::Mat& values, const cv::Mat& mask, double share);

/// A frame of the given width along the picture's border: 255 there, 0 elsewhere.
cv::Mat border_band(cv::Size size, int width);

/// The outer and inner boundary pixels of a mask.
cv::Mat contour_of(const cv::Mat& mask);

/// Squared distance between two Lab colours.
inline float distance2(const cv::Vec3f& a, const cv::Vec3f& b) {
  const cv::Vec3f d = a - b;
  return d.dot(d);
}

/// Mean of the three channels of `picture` over the pixels of `mask` within a square window; `weight` receives the
/// share of the window that is masked.
cv::Mat local_mean(const cv::Mat& picture, const cv::Mat& mask, int radius, cv::Mat& weight);

}  // namespace vitrine
