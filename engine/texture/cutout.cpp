// SPDX-License-Identifier: GPL-3.0-or-later
#include "cutout.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

#include "fill.hpp"
#include "print.hpp"
#include "rim.hpp"

namespace vitrine {
namespace {

// A garment may overhang its photo by a little where the panel is smoothed, never by whole pictures.
constexpr double kLargestOverhang = 512;  // [px]
constexpr int kLargestSide = 1 << 15;     // [px]
// Places that are not kept and wider than twice this are filled with cloth; narrower ones take the edge's colours.
constexpr float kWide = 8.0F;   // [px]
constexpr double kHem = 0.025;  // [m]
// Around the inside of the back lies the neckline's binding.
constexpr double kBinding = 0.045;  // [m]

Error internal(const std::string& message) {
  return {Cause::internal, "BAD_TEXTURE_SOURCE", message, "Report this with the photos that caused it.", "texture"};
}

Result<bool> check(const TextureSource& s) {
  if (!s.rgb || !s.labels || !s.panel || !s.mesh) return internal("A panel came without its photo, labels or mesh.");
  const auto whole = [](const Image& i, int channels) {
    return i.channels == channels && i.width > 0 && i.height > 0 && i.width <= kLargestSide &&
           i.height <= kLargestSide && i.data.size() == static_cast<std::size_t>(i.width) * i.height * channels;
  };
  if (!whole(*s.rgb, 3) || !whole(*s.labels, 1)) return internal("A panel's photo or labels are not a whole picture.");
  if (s.rgb->width != s.labels->width || s.rgb->height != s.labels->height)
    return internal("A panel's photo and labels differ in size.");
  if (s.mesh->nodes.empty()) return internal("A panel has no nodes.");
  for (const Triangle& t : s.mesh->triangles)
    if (std::max({t[0], t[1], t[2]}) >= s.mesh->nodes.size()) return internal("A panel has a triangle without nodes.");
  return true;
}

/// Distance of each non-zero pixel to the nearest zero one; beyond the picture all is zero.
cv::Mat depth_of(const cv::Mat& mask) {
  cv::Mat padded, depth;
  cv::copyMakeBorder(mask, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  cv::distanceTransform(padded, depth, cv::DIST_L2, cv::DIST_MASK_5);
  return depth(cv::Rect(cv::Point(1, 1), mask.size())).clone();
}

/// Pixels that the panel's triangles cover.
cv::Mat panel_region(const TextureSource& source, const Cutout& cut) {
  cv::Mat region = cv::Mat::zeros(cut.rgb.size(), CV_8UC1);
  constexpr int shift = 4;  // sixteenths of a pixel
  const auto place = [&](std::uint32_t node) {
    const Vec2& p = cut.pixels[node];
    return cv::Point(static_cast<int>(std::lround((p.x() - cut.left) * (1 << shift))),
                     static_cast<int>(std::lround((p.y() - cut.top) * (1 << shift))));
  };
  for (const Triangle& t : source.mesh->triangles) {
    const cv::Point corners[] = {place(t[0]), place(t[1]), place(t[2])};
    cv::fillConvexPoly(region, corners, 3, cv::Scalar::all(255), cv::LINE_8, shift);
  }
  return region;
}

}  // namespace

Result<Cutout> cut_out(const TextureSource& source, int margin) {
  if (auto ok = check(source); !ok) return ok.error();
  const Affine2& map = source.panel->pixel_from_panel;
  const int width = source.rgb->width, height = source.rgb->height;

  Cutout out;
  out.density = std::sqrt(std::abs(map.axis_x.x() * map.axis_y.y() - map.axis_x.y() * map.axis_y.x()));
  if (!std::isfinite(out.density) || out.density <= 0) return internal("A panel has no scale in its photo.");
  Vec2 low(1e30, 1e30), high(-1e30, -1e30);
  for (const Vec2& node : source.mesh->nodes) {
    const Vec2 p = map(node);
    if (!p.allFinite()) return internal("A panel node has no place in its photo.");
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    out.pixels.push_back(p);
  }
  if (low.minCoeff() < -kLargestOverhang || high.x() > width + kLargestOverhang || high.y() > height + kLargestOverhang)
    return internal("A panel lies outside its photo.");

  out.left = static_cast<int>(std::floor(low.x())) - margin;
  out.top = static_cast<int>(std::floor(low.y())) - margin;
  const cv::Size size(static_cast<int>(std::ceil(high.x())) + margin + 1 - out.left,
                      static_cast<int>(std::ceil(high.y())) + margin + 1 - out.top);
  out.rgb = cv::Mat(size, CV_8UC3, cv::Scalar::all(0));
  // 255 outside face, 0 anything else; `off` marks board and inside.
  cv::Mat outside(size, CV_8UC1, cv::Scalar::all(0)), off = outside.clone(), inside = outside.clone();
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const int px = x + out.left, py = y + out.top;
      if (px < 0 || py < 0 || px >= width || py >= height) continue;
      const std::uint8_t* colour = source.rgb->at(px, py);
      out.rgb.at<cv::Vec3b>(y, x) = {colour[0], colour[1], colour[2]};
      const bool own = *source.labels->at(px, py) == label_outside;
      outside.at<uchar>(y, x) = own ? 255 : 0;
      off.at<uchar>(y, x) = own ? 0 : 255;
      inside.at<uchar>(y, x) = *source.labels->at(px, py) == label_inside ? 255 : 0;
    }
  if (cv::countNonZero(outside) == 0)
    return Error{Cause::unusable, "NO_TEXTURE", "The panel covers no pixel of the garment in its photo.",
                 "Check the photo's mask, or let the garment be found without one.", "texture"};

  const cv::Mat depth = depth_of(outside);
  const cv::Mat panel = panel_region(source, out);
  out.keep = outside.clone();
  drop_rim(out.rgb, depth, off, out.keep);
  const double area = std::max(1, cv::countNonZero(panel));
  if (source.borrowed) {
    const cv::Mat print = find_print(out.rgb, outside, depth, out.density) & panel;
    out.print_share = cv::countNonZero(print) / area;
    cv::Mat around = inside.clone();
    if (cv::countNonZero(inside) > 0) {
      const int side = 2 * static_cast<int>(std::lround(kBinding * out.density)) + 1;
      cv::dilate(inside, around, cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side}));
    }
    out.keep.setTo(0, print | around);
    if (cv::countNonZero(out.keep) == 0) out.keep = outside.clone();
  }
  // Where the panel wants cloth and the photo has none: over the inside and its label, a print, a hole in the mask.
  const cv::Mat missing = panel & (out.keep == 0);
  const cv::Mat deep = depth_of(missing) > kWide;
  if (cv::countNonZero(deep) > 0) {
    cv::Mat reach;
    cv::dilate(deep, reach, cv::getStructuringElement(cv::MORPH_ELLIPSE, {25, 25}));
    const cv::Mat hole = missing & reach;
    // Bindings and hems belong to their border and are copied only where there is nothing else.
    const cv::Mat inner = depth_of(out.keep) > kHem * out.density;
    cv::Mat left = fill_with_cloth(out.rgb, hole, out.keep, inner);
    const cv::Mat known = out.keep | (hole & (left == 0));
    left = fill_with_cloth(out.rgb, left, known, out.keep);
    out.keep |= hole & (left == 0);
    out.filled_share = cv::countNonZero(hole) / area;
  }
  const cv::Mat whole = outside | out.keep;
  bleed(out.rgb, out.keep, whole, depth_of(whole));
  return out;
}

}  // namespace vitrine
