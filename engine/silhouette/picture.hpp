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

/// The picture the models run on, and what more than one of them asks of it.
struct WorkPicture {
  cv::Mat rgb;    ///< CV_8UC3
  cv::Mat lab;    ///< lab_from_rgb
  cv::Mat edges;  ///< sobel_magnitude
  explicit WorkPicture(const cv::Mat& picture)
      : rgb(picture), lab(lab_from_rgb(picture)), edges(sobel_magnitude(picture)) {}
};

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

/// Local mean colours on both sides of a mask's contour, where pixels within `reach` of it count for neither side.
struct Sides {
  cv::Mat in, out;                ///< CV_32FC3
  cv::Mat weight_in, weight_out;  ///< CV_32F, share of the window that is sure to be of that side
  Sides(const cv::Mat& lab, const cv::Mat& mask, int reach);
};

/// Mean of the three channels of `picture` over the pixels of `mask` within a square window; `weight` receives the
/// share of the window that is masked.
cv::Mat local_mean(const cv::Mat& picture, const cv::Mat& mask, int radius, cv::Mat& weight);

}  // namespace vitrine
