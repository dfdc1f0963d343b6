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

/// The cut at working size, brought back to the photo's own size.
cv::Mat colour_mask(const cv::Mat& rgb, int working_side, double& second) {
  const int side = std::max(rgb.cols, rgb.rows);
  const double scale = std::min(1.0, static_cast<double>(std::max(working_side, 64)) / side);
  cv::Mat small = rgb;
  if (scale < 1) cv::resize(rgb, small, {}, scale, scale, cv::INTER_AREA);
  cv::Mat like, cut = cut_by_colour(small, like);
  if (cv::countNonZero(cut) == 0) return cv::Mat::zeros(rgb.size(), CV_8U);
  cut = fill_enclosed(main_piece(cut, &second), like);
  cut = without_loose_ends(cut, loose_radius(cut));
  if (scale < 1) {
    cv::resize(cut, cut, rgb.size(), 0, 0, cv::INTER_LINEAR);
    cut = cut > 127;
  }
  return cut;
}

Result<Silhouette> find(const Photo& photo, const SilhouetteOptions& options) {
  const cv::Mat rgb = view(photo.rgb);
  Silhouette out;
  cv::Mat mask;
  double second = 0;  // the next largest piece, as a share of the garment
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
    Scan scan = scan_edges(rgb);
    if (scan.doubt.empty()) {
      out.method = "sobel";
      second = scan.second;
      mask = without_loose_ends(scan.mask, loose_radius(scan.mask));
      const double lost = 1 - cv::countNonZero(mask) / std::max(1.0, static_cast<double>(cv::countNonZero(scan.mask)));
      if (lost > 0.01) scan.doubt = "something thin hangs on the garment";
    }
    if (!scan.doubt.empty()) {
      out.method = "colour";
      out.method_reason = scan.doubt;
      mask = colour_mask(rgb, options.working_side, second);
    }
    if (cv::countNonZero(mask) > 0) {
      const int side = std::max(rgb.cols, rgb.rows);
      const int reach = out.method == "sobel" ? 2 : std::max(2, 2 * side / std::max(options.working_side, 64));
      mask = main_piece(refine_contour(rgb, mask, reach));
    }
  }
  if (second > several_share) return several_garments(photo);
  std::optional<Error> refused = judge(photo, mask, options, out);
  if (refused) return *refused;
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
