// SPDX-License-Identifier: GPL-3.0-or-later
#include "frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vitrine::panels_room {
namespace {

constexpr double kSmallest = 0.05, kLargest = 3.0;  ///< [m] what a garment can measure
constexpr double kMostShorter = 0.6;                ///< [-] beyond, the width is not this body's
constexpr double kDisagreement = 0.15;              ///< [-] chest and length may differ by this before we warn

/// Takes picture axes to the garment's: the garment's horizontal axis lies at `tilt_deg` in the picture.
struct Turn2 {
  double c, s;
  explicit Turn2(double tilt_deg)
      : c(std::cos(tilt_deg * std::numbers::pi / 180)), s(std::sin(tilt_deg * std::numbers::pi / 180)) {}
  Vec2 upright(const Vec2& q) const { return {c * q.x() + s * q.y(), -s * q.x() + c * q.y()}; }
  Vec2 picture(const Vec2& u) const { return {c * u.x() - s * u.y(), s * u.x() + c * u.y()}; }
};

int partner(const GarmentTemplate& garment, int feature) {
  const int mirror = garment.features[feature].mirror;
  return mirror >= 0 ? mirror : feature;
}

Error bad_measurement(const std::string& what, double value) {
  return {Cause::usage, "BAD_MEASUREMENT",
          "The " + what + " of " + std::to_string(value) + " m is not a length between 0.05 m and 3 m.",
          "Give the " + what + " in the unit the option names, or leave it out.", "panels"};
}

bool out_of_range(double metres) {
  return !std::isfinite(metres) || metres < kSmallest || metres > kLargest;
}

std::string percent(double share) {
  return std::to_string(static_cast<int>(std::lround(100 * share))) + " %";
}

}  // namespace

std::vector<Vec2> upright_pixels(const Features& features) {
  const Turn2 turn(features.tilt_deg);
  std::vector<Vec2> upright;
  upright.reserve(features.points.size());
  for (const FeaturePoint& p : features.points) upright.push_back(turn.upright(p.pixel));
  return upright;
}

std::vector<Vec2> upright_contour(const Features& features) {
  const Turn2 turn(features.tilt_deg);
  std::vector<Vec2> upright;
  upright.reserve(features.contour.size());
  for (const Vec2& p : features.contour) upright.push_back(turn.upright(p));
  return upright;
}

double scale_distance(const std::vector<Vec2>& upright, const ScaleRule& rule) {
  return (upright[rule.feature_a] - upright[rule.feature_b]).norm();
}

double scale_height(const std::vector<Vec2>& upright, const GarmentTemplate& garment) {
  const auto height = [&](int feature) {
    return 0.5 * (upright[feature].y() + upright[partner(garment, feature)].y());
  };
  return std::abs(height(garment.scale.bottom) - height(garment.scale.top));
}

Result<FrontScale> front_scale(const std::vector<Vec2>& upright, const GarmentTemplate& garment,
                               const PanelOptions& options) {
  const double width_px = scale_distance(upright, garment.scale), height_px = scale_height(upright, garment);
  if (options.chest != 0 && out_of_range(options.chest)) return bad_measurement("chest width", options.chest);
  if (options.length != 0 && out_of_range(options.length)) return bad_measurement("length", options.length);
  const auto too_small = [](const std::string& what) {
    return Error{Cause::unusable, "DEGENERATE_OUTLINE",
                 "The features that measure the garment's " + what + " lie within four pixels of each other.",
                 "Check the feature points of the front photo, or use a larger photo.", "panels"};
  };
  FrontScale scale;
  if (options.chest != 0) {
    if (!(width_px >= 4)) return too_small("width");
    scale.metres_per_pixel = options.chest / width_px;
    scale.source = "chest";
    const double off = options.length != 0 ? height_px * scale.metres_per_pixel / options.length - 1 : 0;
    if (std::abs(off) > kDisagreement)
      scale.warning = "SCALE: at the given chest width the photo's length is " + percent(std::abs(off)) +
                      (off > 0 ? " more" : " less") + " than the given length; the chest width was used";
    return scale;
  }
  if (options.length != 0) {
    if (!(height_px >= 4)) return too_small("length");
    scale.metres_per_pixel = options.length / height_px;
    scale.source = "length";
    return scale;
  }
  if (!(width_px >= 4)) return too_small("width");
  const auto girth = options.girths.find(garment.scale.girth);
  if (girth == options.girths.end())
    return Error{Cause::usage, "MISSING_GIRTH",
                 "The garment's size follows the body girth '" + garment.scale.girth + "', which is not known.",
                 "Give the chest width or the length of the garment.", "panels"};
  if (out_of_range(girth->second)) return bad_measurement(girth->first + " girth", girth->second);
  const double half = 0.5 * girth->second * garment.scale.ease;
  if (out_of_range(half)) return bad_measurement("width by the template's ease", half);
  scale.metres_per_pixel = half / width_px;
  scale.source = "ease";
  return scale;
}

double anchor_height(const std::vector<Vec2>& upright, const GarmentTemplate& garment) {
  double y = 0, top = upright.front().y();
  for (int anchor : garment.anchors) y += upright[anchor].y();
  for (const Vec2& p : upright) top = std::min(top, p.y());
  return garment.anchors.empty() ? top : y / static_cast<double>(garment.anchors.size());
}

double shortened(const std::vector<Vec2>& contour, double anchor_y, double metres_per_pixel, double room) {
  double low = anchor_y;
  for (const Vec2& p : contour) low = std::max(low, p.y());
  const double length = (low - anchor_y) * metres_per_pixel;
  return room > 0 && length > room ? std::max(kMostShorter, room / length) : 1;
}

Affine2 pixel_from_panel(const std::vector<Vec2>& upright, double tilt_deg, double metres_per_pixel, double shorter,
                         const GarmentTemplate& garment) {
  double x = 0;
  int pairs = 0;
  for (int i = 0; i < static_cast<int>(upright.size()); ++i) {
    if (partner(garment, i) == i) continue;
    x += upright[i].x();
    ++pairs;
  }
  Vec2 low = upright.front(), high = low;
  for (const Vec2& p : upright) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  x = pairs > 0 ? x / pairs : 0.5 * (low.x() + high.x());
  const double y = anchor_height(upright, garment);

  const Turn2 turn(tilt_deg);
  Affine2 affine;
  affine.origin = turn.picture({x, y});
  affine.axis_x = turn.picture({1 / metres_per_pixel, 0});
  affine.axis_y = turn.picture({0, -1 / (metres_per_pixel * shorter)});  // the picture's y points down
  return affine;
}

}  // namespace vitrine::panels_room
