// SPDX-License-Identifier: GPL-3.0-or-later
#include "print.hpp"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "vitrine/colour.hpp"

namespace vitrine {
namespace {

// The band that shows the cloth: behind bindings and hems, before a print on the chest begins.
constexpr double kBandStart = 0.030, kBandEnd = 0.075;  // [m] from the border
constexpr double kShallow = 0.6;         // lightness differences count less: folds and falloff are no print
constexpr double kDifferent = 10.0;      // [Lab, lightness shallow] from every colour of the band
constexpr double kCommon = 0.004;        // share of the band from which a colour is the cloth's
constexpr double kLargestShare = 0.5;    // of the panel; beyond, the band is the exception and not the print
constexpr double kSmallestShare = 0.02;  // of the panel; less is a deep fold, or what can be told of a print too little
constexpr double kSpeck = 0.004;         // [m] smaller marks are weave, dust or buttons
constexpr double kGap = 0.012;           // [m] between letters
constexpr double kSmallest = 4e-4;       // [m^2] of a print
constexpr double kHalo = 0.004;          // [m] around it

using Colour = std::array<float, 3>;

double difference(const Colour& a, const Colour& b) {
  const double l = kShallow * (a[0] - b[0]), u = a[1] - b[1], v = a[2] - b[2];
  return std::sqrt(l * l + u * u + v * v);
}

cv::Mat disc(double radius) {
  const int side = 2 * std::max(1, static_cast<int>(std::lround(radius))) + 1;
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side});
}

}  // namespace

cv::Mat find_print(const cv::Mat& rgb, const cv::Mat& panel, const cv::Mat& depth, double density) {
  // Lab of a lightly smoothed picture: weave and noise are no colours of their own.
  cv::Mat soft, lab(rgb.size(), CV_32FC3);
  cv::GaussianBlur(rgb, soft, {}, 1.2, 1.2, cv::BORDER_REPLICATE);
  for (int y = 0; y < rgb.rows; ++y) lab_from_srgb(soft.ptr(y), lab.ptr<float>(y), rgb.cols);

  const cv::Mat band = (depth > kBandStart * density) & (depth < kBandEnd * density) & panel;
  const int bandwidth = cv::countNonZero(band);
  cv::Mat print = cv::Mat::zeros(rgb.size(), CV_8UC1);
  if (bandwidth < 400) return print;
  // Cells of 6 Lab units hold the band's colours.
  const auto cell = [](const cv::Vec3f& c) {
    return (static_cast<int>(c[0] / 6.0F) * 64 + static_cast<int>((c[1] + 128.0F) / 6.0F)) * 64 +
           static_cast<int>((c[2] + 128.0F) / 6.0F);
  };
  std::vector<int> count(20 * 64 * 64, 0);
  std::vector<cv::Vec3d> sum(count.size(), cv::Vec3d::all(0));
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x)
      if (band.at<uchar>(y, x)) {
        const cv::Vec3f& c = lab.at<cv::Vec3f>(y, x);
        ++count[cell(c)];
        sum[cell(c)] += cv::Vec3d(c);
      }
  std::vector<Colour> cloth;
  for (std::size_t i = 0; i < count.size(); ++i)
    if (count[i] > kCommon * bandwidth) {
      const cv::Vec3d mean = sum[i] * (1.0 / count[i]);
      cloth.push_back({static_cast<float>(mean[0]), static_cast<float>(mean[1]), static_cast<float>(mean[2])});
    }
  if (cloth.empty()) return print;
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) {
      if (!panel.at<uchar>(y, x) || depth.at<float>(y, x) <= kBandStart * density) continue;
      const cv::Vec3f& c = lab.at<cv::Vec3f>(y, x);
      const Colour own{c[0], c[1], c[2]};
      const bool known = std::any_of(cloth.begin(), cloth.end(),
                                     [&](const Colour& other) { return difference(own, other) < kDifferent; });
      if (!known) print.at<uchar>(y, x) = 255;
    }
  if (const double radius = kSpeck * density / 4; radius >= 1)
    cv::morphologyEx(print, print, cv::MORPH_OPEN, disc(radius));
  cv::morphologyEx(print, print, cv::MORPH_CLOSE, disc(kGap * density / 2));
  cv::Mat labels, figures, middles;
  const int parts = cv::connectedComponentsWithStats(print, labels, figures, middles, 8, CV_32S);
  for (int i = 1; i < parts; ++i)
    if (figures.at<int>(i, cv::CC_STAT_AREA) < kSmallest * density * density) print.setTo(0, labels == i);
  if (cv::countNonZero(print) < kSmallestShare * cv::countNonZero(panel) ||
      cv::countNonZero(print) > kLargestShare * cv::countNonZero(panel))
    return cv::Mat::zeros(rgb.size(), CV_8UC1);
  if (cv::countNonZero(print) > 0) cv::dilate(print, print, disc(kHalo * density));
  print &= panel;
  return print;
}

}  // namespace vitrine
