// SPDX-License-Identifier: GPL-3.0-or-later
#include "gates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "picture.hpp"

namespace vitrine {
namespace {

Error refuse(const Photo& photo, const char* code, const std::string& what, const std::string& remedy) {
  return {Cause::unusable, code, photo.path + ": " + what, remedy, "silhouette"};
}

constexpr double cut_share = 0.25;        ///< part of the garment's width or height that the frame may graze
constexpr double min_sides_differ = 0.7;  ///< share of the contour
constexpr double min_edge_support = 0.6;  ///< share of the contour
constexpr double least_difference = 3.0;  ///< [Lab] between the means of both sides of the contour
constexpr float least_step = 12;          ///< [Lab] lightness across the contour from which blur can be told
constexpr double much_blur = 0.0035, max_blur = 0.006;  ///< [-] of the picture's longer side; a sharp photo has 0.002
constexpr float least_edge = 24;                        ///< Sobel magnitude, a step of 6 grey values

/// The longest stretch of one picture side that the garment covers, as a share of its extent along that side.
double cut_by_frame(const cv::Mat& mask) {
  const cv::Rect box = cv::boundingRect(mask);
  const double along_x = std::max(cv::countNonZero(mask.row(0)), cv::countNonZero(mask.row(mask.rows - 1)));
  const double along_y = std::max(cv::countNonZero(mask.col(0)), cv::countNonZero(mask.col(mask.cols - 1)));
  return std::max(along_x / std::max(1, box.width), along_y / std::max(1, box.height));
}

struct Contrast {
  double edge_support = 0, sides_differ = 0;
  double blur = 0;  ///< [px] median standard deviation of the contour's transition; 0 = cannot be told
};

/// Standard deviation [px] of the transition at a contour pixel: a step of height h blurred by s is steepest with
/// h / (s sqrt(2 pi)) a pixel.
double transition(const cv::Mat& lab, int y, int x, float step) {
  float steepest = 0;
  for (int v = std::max(1, y - 2); v <= std::min(lab.rows - 2, y + 2); ++v)
    for (int u = std::max(1, x - 2); u <= std::min(lab.cols - 2, x + 2); ++u)
      steepest = std::max(steepest, std::hypot(lab.at<cv::Vec3f>(v, u + 1)[0] - lab.at<cv::Vec3f>(v, u - 1)[0],
                                               lab.at<cv::Vec3f>(v + 1, u)[0] - lab.at<cv::Vec3f>(v - 1, u)[0]) /
                                        2);
  return step / (std::max(steepest, 1e-3f) * std::sqrt(2 * std::numbers::pi));
}

Contrast contrast_along(const WorkPicture& work, const cv::Mat& mask, const Sides& sides) {
  const cv::Mat contour = contour_of(mask);
  cv::Mat edge;
  cv::dilate(work.edges, edge, cv::Mat());
  double n = 0, supported = 0, differ = 0;
  std::vector<double> blur;
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) {
      if (!contour.at<std::uint8_t>(y, x)) continue;
      n += 1;
      supported += edge.at<float>(y, x) > least_edge;
      differ +=
          distance2(sides.in.at<cv::Vec3f>(y, x), sides.out.at<cv::Vec3f>(y, x)) > least_difference * least_difference;
      const float step = std::abs(sides.in.at<cv::Vec3f>(y, x)[0] - sides.out.at<cv::Vec3f>(y, x)[0]);
      if (step > least_step) blur.push_back(transition(work.lab, y, x, step));
    }
  Contrast c{supported / std::max(n, 1.0), differ / std::max(n, 1.0), 0};
  if (static_cast<double>(blur.size()) < 0.2 * n || blur.empty()) return c;
  const auto middle = blur.begin() + static_cast<std::ptrdiff_t>(blur.size() / 2);
  std::nth_element(blur.begin(), middle, blur.end());
  c.blur = *middle;
  return c;
}

}  // namespace

Error several_garments(const Photo& photo) {
  return refuse(photo, "SEVERAL_GARMENTS", "the photo shows more than one garment.",
                "Photograph each garment on its own, or crop the photo to one garment.");
}

std::optional<Error> judge(const Photo& photo, const WorkPicture& work, const cv::Mat& mask, const Sides& sides,
                           const SilhouetteOptions& options, Silhouette& out) {
  const int area = cv::countNonZero(mask);
  const bool drawn = out.method == "mask" || out.method == "alpha";
  if (area == 0 && drawn)
    return refuse(photo, "TOO_SMALL", "the mask or the transparency leaves nothing of the garment.",
                  "Check the mask, or save the photo without transparency.");
  if (area == 0)
    return refuse(photo, "LOW_CONTRAST", "the garment cannot be told from the ground it lies on.",
                  "Lay it on a board of another colour: a light garment on dark, a dark one on white; or add a mask.");
  if (area < options.min_area * static_cast<double>(mask.total()))
    return refuse(photo, "TOO_SMALL", "the garment covers too little of the photo.",
                  "Go closer or crop the photo, so that the garment fills most of the picture.");
  const Contrast c = contrast_along(work, mask, sides);
  out.edge_support = c.edge_support;
  out.contrast = c.sides_differ;
  const double cut = cut_by_frame(mask);
  // What the shop drew is the shop's word: the gates then only warn.
  if (cut > cut_share && !drawn)
    return refuse(photo, "TOUCHES_FRAME", "the garment is cut off by the border of the photo.",
                  "Step back until some of the board shows on all four sides of the garment.");
  if (cut > 0) out.warnings.push_back("TOUCHES_FRAME");
  const double needed = options.min_contrast > 0 ? options.min_contrast : min_sides_differ;
  if (!drawn && (c.sides_differ < needed || c.edge_support < min_edge_support))
    return refuse(photo, "LOW_CONTRAST", "along much of its outline the garment looks like the ground it lies on.",
                  "Lay it on a board of another colour: a light garment on dark, a dark one on white; or add a mask.");
  const double blur = c.blur / std::max(mask.cols, mask.rows);
  // A drawn outline need not lie on the edge, so that nothing can be said of the edge's width.
  if (blur > max_blur && !drawn)
    return refuse(photo, "BLURRED", "the photo is out of focus or shaken.",
                  "Take it again with a steady camera and the focus on the garment.");
  if (blur > much_blur && !drawn) out.warnings.push_back("BLURRED");
  if (!drawn && (c.sides_differ < 0.9 || c.edge_support < 0.85)) out.warnings.push_back("LOW_CONTRAST");
  return std::nullopt;
}

}  // namespace vitrine
