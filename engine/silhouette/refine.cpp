// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "picture.hpp"

namespace vitrine {

cv::Mat refine_contour(const cv::Mat& rgb, const cv::Mat& mask, int reach) {
  const cv::Mat lab = lab_from_rgb(rgb);
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1});
  cv::Mat inner, outer, weight_in, weight_out;
  cv::erode(mask, inner, kernel, {-1, -1}, 1, cv::BORDER_REPLICATE);
  cv::dilate(mask, outer, kernel);
  const cv::Mat ground = ~outer;
  const int window = 3 * reach + 2;
  const cv::Mat mean_in = local_mean(lab, inner, window, weight_in),
                mean_out = local_mean(lab, ground, window, weight_out);
  cv::Mat soft, prior;
  mask.convertTo(prior, CV_32F, 1.0 / 255.0);
  cv::GaussianBlur(prior, prior, {}, 0.8 * reach);
  soft = prior.clone();
  const cv::Mat band = outer & ~inner;
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) {
      if (!band.at<std::uint8_t>(y, x)) {
        soft.at<float>(y, x) = mask.at<std::uint8_t>(y, x) ? 1.0f : 0.0f;
        continue;
      }
      // Narrow straps and gaps have no sure pixels of one side nearby; there the rough mask is all there is.
      if (weight_in.at<float>(y, x) < 0.01f || weight_out.at<float>(y, x) < 0.01f) {
        soft.at<float>(y, x) = mask.at<std::uint8_t>(y, x) ? 1.0f : 0.0f;
        continue;
      }
      const cv::Vec3f in = mean_in.at<cv::Vec3f>(y, x), out = mean_out.at<cv::Vec3f>(y, x), c = lab.at<cv::Vec3f>(y, x);
      const float apart = distance2(in, out);
      const float along = apart > 1e-6f ? (c - out).dot(in - out) / apart : 0.5f;
      const float trust = apart / (apart + 100.0f);  // half trust at 10 Lab units
      const float p = std::clamp(along, 0.0f, 1.0f);
      soft.at<float>(y, x) = trust * (0.75f * p + 0.25f * prior.at<float>(y, x)) + (1 - trust) * prior.at<float>(y, x);
    }
  cv::GaussianBlur(soft, soft, {}, 0.7);
  return soft > 0.5;
}

}  // namespace vitrine
