// SPDX-License-Identifier: GPL-3.0-or-later
// From the front frame back to the photo as it was given: sides, pixels, size.
#include "as_given.hpp"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace vitrine {
namespace {

bool ends_with(const std::string& name, const std::string& end) {
  return name.size() >= end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
}

/// Name of the same feature in a mirrored picture: what the front frame calls left is the right of a back photo.
std::string swap_sides(const std::string& name) {
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"_left", "_right"}, {"_right", "_left"}})
    if (ends_with(name, from)) return name.substr(0, name.size() - from.size()) + to;
  return name;
}

NamedPoint neckline_low(Side side, const Features& features) {
  NamedPoint low{"neck_low", side == Side::front ? "neck_front" : "neck_back", features.neckline.low, "neckline", 0.7};
  const auto& warnings = features.warnings;
  if (side == Side::back || features.neckline.inside_found) low.confidence = 0.9;
  // The line found may then be the back's.
  if (std::find(warnings.begin(), warnings.end(), "NECKLINE_UNCLEAR") != warnings.end()) low.confidence = 0.4;
  return low;
}

/// Lowest point of the open edge on which a garment without a neckline hangs (a skirt's waist), named after its ends.
std::optional<NamedPoint> opening_low(const GarmentTemplate& garment, const Features& features) {
  if (garment.neck_edge() >= 0) return std::nullopt;
  const std::string left = "_left";
  for (const TemplateEdge& edge : garment.edges) {
    const auto anchors = [&](int f) {
      return std::find(garment.anchors.begin(), garment.anchors.end(), f) != garment.anchors.end();
    };
    const bool hangs = anchors(edge.from) && anchors(edge.to);
    if (!hangs || edge.kind != EdgeKind::open || !ends_with(garment.features[edge.from].name, left)) continue;
    const FeaturePoint &from = features.points[edge.from], &to = features.points[edge.to];
    const Vec2 along = to.pixel - from.pixel, down(-along.y(), along.x());
    Vec2 low = (from.pixel + to.pixel) / 2;
    double lowest = -1e30;
    const int n = static_cast<int>(features.contour.size());
    for (int i = from.contour_index; i != to.contour_index; i = (i + 1) % n) {
      const Vec2 p = features.contour[i] - from.pixel;
      const double across = p.dot(along) / along.squaredNorm(), depth = p.dot(down) / along.squaredNorm();
      // The rounded corners belong to the ends; of points about equally low on a straight waist the middle one counts.
      if (across < 0.15 || across > 0.85 || depth - 0.08 * (across - 0.5) * (across - 0.5) < lowest) continue;
      lowest = depth - 0.08 * (across - 0.5) * (across - 0.5);
      low = features.contour[i];
    }
    return NamedPoint{from.name.substr(0, from.name.size() - left.size()) + "_low", "", low, "outline",
                      std::min(from.confidence, to.confidence)};
  }
  return std::nullopt;
}

}  // namespace

Vec2 pixel_as_given(const Photo& photo, Vec2 p) {
  // The rooms' picture was mirrored first and then turned: back in the other order.
  int width = photo.rgb.width, height = photo.rgb.height;
  for (int k = 0; k < photo.quarter_turns; ++k) {
    p = Vec2(height - 1 - p.y(), p.x());
    std::swap(width, height);
  }
  if (photo.mirrored) p.x() = width - 1 - p.x();
  // Centres of pixels stand at whole numbers; a reduced picture's borders, not its centres, are those of the source.
  const Vec2 scale(static_cast<double>(photo.source_width) / width, static_cast<double>(photo.source_height) / height);
  return (p + Vec2(0.5, 0.5)).cwiseProduct(scale) - Vec2(0.5, 0.5);
}

Image as_given(const Photo& photo, const Image& image) {
  Image given = turned(image, 4 - photo.quarter_turns);
  if (!photo.mirrored) return given;
  cv::Mat m(given.height, given.width, CV_8UC(given.channels), given.data.data());
  cv::flip(m, m, 1);
  return given;
}

Image resize_labels(const Image& labels, int width, int height) {
  if (labels.width == width && labels.height == height) return labels;
  const cv::Mat from(labels.height, labels.width, CV_8U, const_cast<std::uint8_t*>(labels.data.data()));
  Image result(width, height, 1);
  cv::Mat to(height, width, CV_8U, result.data.data());
  cv::Mat region;
  // Each border is drawn by interpolation, so that it stays smooth; labels themselves cannot be interpolated.
  cv::resize(from != label_background, region, to.size(), 0, 0, cv::INTER_LINEAR);
  to.setTo(label_outside, region >= 128);
  cv::Mat inside;
  cv::resize(from == label_inside, inside, to.size(), 0, 0, cv::INTER_LINEAR);
  cv::Mat outside;
  cv::resize(from == label_outside, outside, to.size(), 0, 0, cv::INTER_LINEAR);
  to.setTo(label_inside, (region >= 128) & (inside > outside));
  return result;
}

const Image& labels_of(const View& view) {
  return view.features.labels.empty() ? view.silhouette.labels : view.features.labels;
}

Image mask_as_given(const View& view) {
  if (labels_of(view).empty()) return {};
  return resize_labels(as_given(view.photo, labels_of(view)), view.photo.source_width, view.photo.source_height);
}

std::vector<NamedPoint> points_as_given(const ViewRequest& request, const View& view) {
  const Features& features = view.features;
  std::vector<NamedPoint> points;
  for (const FeaturePoint& f : features.points) points.push_back({f.name, f.landmark, f.pixel, f.origin, f.confidence});
  if (!points.empty()) {
    if (!features.neckline.id.empty()) points.push_back(neckline_low(request.side, features));
    if (auto low = opening_low(request.garment, features)) points.push_back(*std::move(low));
  }
  for (NamedPoint& p : points) {
    if (view.photo.mirrored) p.name = swap_sides(p.name);
    p.pixel = pixel_as_given(view.photo, p.pixel);
  }
  return points;
}

}  // namespace vitrine
