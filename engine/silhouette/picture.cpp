// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "vitrine/colour.hpp"

namespace vitrine {

cv::Mat view(const Image& image) {
  return cv::Mat(image.height, image.width, CV_8UC(image.channels), const_cast<std::uint8_t*>(image.data.data()));
}

cv::Mat lab_from_rgb(const cv::Mat& rgb) {
  cv::Mat lab(rgb.size(), CV_32FC3);
  for (int y = 0; y < rgb.rows; ++y) lab_from_srgb(rgb.ptr(y), lab.ptr<float>(y), static_cast<std::size_t>(rgb.cols));
  return lab;
}

cv::Mat sobel_magnitude(const cv::Mat& rgb) {
  cv::Mat gx, gy, out(rgb.size(), CV_32F);
  cv::Sobel(rgb, gx, CV_16S, 1, 0, 3);
  cv::Sobel(rgb, gy, CV_16S, 0, 1, 3);
  for (int y = 0; y < rgb.rows; ++y) {
    const std::int16_t *a = gx.ptr<std::int16_t>(y), *b = gy.ptr<std::int16_t>(y);
    float* o = out.ptr<float>(y);
    for (int x = 0; x < rgb.cols; ++x, a += 3, b += 3) {
      const auto square = [&](int c) { return a[c] * a[c] + b[c] * b[c]; };
      o[x] = std::sqrt(static_cast<float>(std::max({square(0), square(1), square(2)})));
    }
  }
  return out;
}

float percentile(const cv::Mat& values, const cv::Mat& mask, double share) {
  std::vector<float> v;
  for (int y = 0; y < values.rows; ++y)
    for (int x = 0; x < values.cols; ++x)
      if (mask.at<std::uint8_t>(y, x)) v.push_back(values.at<float>(y, x));
  if (v.empty()) return 0;
  const auto k = static_cast<std::size_t>(share * static_cast<double>(v.size() - 1));
  std::nth_element(v.begin(), v.begin() + k, v.end());
  return v[k];
}

cv::Mat border_band(cv::Size size, int width) {
  cv::Mat band(size, CV_8U, cv::Scalar(255));
  const cv::Rect inner(width, width, size.width - 2 * width, size.height - 2 * width);
  if (inner.width > 0 && inner.height > 0) band(inner).setTo(0);
  return band;
}

cv::Mat contour_of(const cv::Mat& mask) {
  cv::Mat smaller;
  cv::erode(mask, smaller, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}), {-1, -1}, 1, cv::BORDER_REPLICATE);
  return mask & ~smaller;
}

cv::Mat local_mean(const cv::Mat& picture, const cv::Mat& mask, int radius, cv::Mat& weight) {
  const cv::Size window(2 * radius + 1, 2 * radius + 1);
  cv::Mat masked = cv::Mat::zeros(picture.size(), picture.type()), ones, mean;
  picture.copyTo(masked, mask);
  mask.convertTo(ones, CV_32F, 1.0 / 255.0);
  cv::boxFilter(masked, mean, CV_32F, window, {-1, -1}, true, cv::BORDER_CONSTANT);
  cv::boxFilter(ones, weight, CV_32F, window, {-1, -1}, true, cv::BORDER_CONSTANT);
  for (int y = 0; y < mean.rows; ++y)
    for (int x = 0; x < mean.cols; ++x) {
      const float w = weight.at<float>(y, x);
      if (w > 1e-6f) mean.at<cv::Vec3f>(y, x) /= w;
    }
  return mean;
}

Sides::Sides(const cv::Mat& lab, const cv::Mat& mask, int reach) {
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1});
  cv::Mat inner, outer;
  cv::erode(mask, inner, kernel, {-1, -1}, 1, cv::BORDER_REPLICATE);
  cv::dilate(mask, outer, kernel);
  in = local_mean(lab, inner, 3 * reach + 2, weight_in);
  out = local_mean(lab, ~outer, 3 * reach + 2, weight_out);
}

}  // namespace vitrine
