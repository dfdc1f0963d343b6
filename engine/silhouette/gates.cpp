// SPDX-License-Identifier: GPL-3.0-or-later
#include "gates.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "picture.hpp"

namespace vitrine {
namespace {

Error refuse(const Photo& photo, const char* code, const std::string& what, const std::string& remedy) {
  return {Cause::unusable, code, photo.path + ": " + what, remedy, "silhouette"};
}

}  // namespace

Error several_garments(const Photo& photo) {
  return refuse(photo, "SEVERAL_GARMENTS", "the photo shows more than one garment.",
                "Photograph each garment on its own, or crop the photo to one garment.");
}

std::optional<Error> judge(const Photo& photo, const cv::Mat& mask, const SilhouetteOptions& options, Silhouette& out) {
  const cv::Mat rgb = view(photo.rgb);
  const double share = cv::countNonZero(mask) / static_cast<double>(mask.total());
  (void)options;
  (void)share;
  cv::Mat contour = contour_of(mask), thick;
  cv::dilate(sobel_magnitude(rgb), thick, cv::Mat());
  const double n = std::max(1, cv::countNonZero(contour));
  out.edge_support = cv::countNonZero(contour & (thick > 40)) / n;
  return std::nullopt;
}

}  // namespace vitrine
