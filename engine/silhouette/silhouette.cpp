// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/silhouette.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "clean.hpp"
#include "colour_cut.hpp"
#include "gates.hpp"
#include "picture.hpp"
#include "refine.hpp"
#include "scan.hpp"

namespace vitrine {
namespace {

Image to_image(const cv::Mat& m) {
  Image image(m.cols, m.rows, 1);
  for (int y = 0; y < m.rows; ++y)
    std::memcpy(image.data.data() + static_cast<std::size_t>(y) * m.cols, m.ptr(y), static_cast<std::size_t>(m.cols));
  return image;
}

constexpr int cut_side = 176;  ///< [px] of the picture in which colours are told apart

int loose_radius(const cv::Mat& mask) {
  return std::max(1, static_cast<int>(std::lround(0.012 * std::sqrt(static_cast<double>(cv::countNonZero(mask))))));
}

/// An alpha channel says where the garment is only when it takes away a real part of the picture; drawing programs
/// leave a few soft pixels in a corner of pictures that are opaque to every viewer.
bool has_cutout(const Image& alpha) {
  if (alpha.empty()) return false;
  const cv::Mat a = view(alpha);
  return cv::countNonZero(a < 128) >= 0.02 * static_cast<double>(a.total());
}

cv::Mat reduced(const cv::Mat& rgb, int side) {
  cv::Mat small = rgb;
  // Halving is much cheaper than any other step.
  while (std::max(small.cols, small.rows) >= 2 * side) {
    cv::Mat half;
    cv::resize(small, half, {(small.cols + 1) / 2, (small.rows + 1) / 2}, 0, 0, cv::INTER_AREA);
    small = half;
  }
  const double scale = static_cast<double>(side) / std::max(small.cols, small.rows);
  if (scale >= 1) return small;
  cv::Mat out;
  cv::resize(small, out, {std::max(1, cvRound(small.cols * scale)), std::max(1, cvRound(small.rows * scale))}, 0, 0,
             cv::INTER_AREA);
  return out;
}

/// The stronger model: a cut of the colours of a small picture, sharpened on the working picture.
cv::Mat colour_mask(const WorkPicture& work, const cv::Mat& known, double& second) {
  ColourCut cut;
  const cv::Mat small = reduced(work.rgb, cut_side);
  cv::Mat mask = cut.start(small, known), like;
  if (cv::countNonZero(mask) == 0) return cv::Mat::zeros(work.rgb.size(), CV_8U);
  const int reach = static_cast<int>(std::ceil(2.0 * work.rgb.cols / small.cols));
  mask = cut.sharpen(work.lab, main_piece(mask, &second), reach, like);
  mask = fill_enclosed(main_piece(mask), like);
  return without_loose_ends(mask, loose_radius(mask));
}

Result<Silhouette> find(const Photo& photo, const SilhouetteOptions& options) {
  const cv::Mat rgb = view(photo.rgb);
  const WorkPicture work(reduced(rgb, std::max(options.working_side, 64)));
  Silhouette out;
  cv::Mat mask, rough;  // the garment at the photo's size and at working size
  double second = 0;    // the next largest piece, as a share of the garment
  if (!photo.mask.empty()) {
    out.method = "mask";
    out.labels = photo.mask;
    mask = view(photo.mask) > 0;
  } else if (has_cutout(photo.alpha)) {
    out.method = "alpha";
    mask = view(photo.alpha) > 127;
    const cv::Mat piece = main_piece(mask, &second);
    mask = fill_enclosed(piece, ~piece);
  } else {
    const Scan scan = scan_edges(work);
    out.method = scan.doubt.empty() ? "sobel" : "colour";
    out.method_reason = scan.doubt;
    rough = colour_mask(work, scan.doubt.empty() ? scan.mask : cv::Mat(), second);
    if (scan.doubt.empty()) second = std::max(second, scan.second);
  }
  if (rough.empty()) cv::resize(mask, rough, work.rgb.size(), 0, 0, cv::INTER_NEAREST);
  const Sides sides(work.lab, rough, contour_reach);
  if (second > several_share) return several_garments(photo);
  std::optional<Error> refused = judge(photo, work, rough, sides, options, out);
  if (refused) return *refused;
  if (mask.empty()) mask = without_specks(refine_contour(rgb, rough, sides) > 127);
  if (out.method != "mask") out.labels = to_image(mask);
  return out;
}

}  // namespace

Result<Silhouette> find_silhouette(const Photo& photo, const SilhouetteOptions& options) {
  const auto fits = [&](const Image& i, int channels) {
    return i.empty() || (i.width == photo.rgb.width && i.height == photo.rgb.height && i.channels == channels);
  };
  if (photo.rgb.empty() || photo.rgb.channels != 3 || !fits(photo.mask, 1) || !fits(photo.alpha, 1))
    return Error{Cause::internal, "SILHOUETTE_FAILED", photo.path + ": photo, alpha and mask differ in size.",
                 "Report this together with the photo.", "silhouette"};
  try {
    cv::setNumThreads(1);  // the host forks workers; a thread pool would not survive it
    return find(photo, options);
  } catch (const std::exception& e) {
    return Error{Cause::internal, "SILHOUETTE_FAILED",
                 photo.path + ": the outline could not be computed (" + e.what() + ").",
                 "Reduce the photo's size and try again.", "silhouette"};
  }
}

}  // namespace vitrine
