// SPDX-License-Identifier: GPL-3.0-or-later
#include "cutout.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

namespace vitrine {
namespace {

// A garment may overhang its photo by a little where the panel is smoothed, never by whole pictures.
constexpr double kLargestOverhang = 512;  // [px]
constexpr int kLargestSide = 1 << 15;     // [px]
// Lens blur, chroma subsampling and matting mix board and garment over this rim.
constexpr float kRim = 2.0F;  // [px]
// Share of the board in a rim pixel from which it is taken for a mixture.
constexpr float kMixed = 0.08F;
// A rim pixel this much darker than the cloth behind it lies in the gap under the edge.
constexpr float kShadow = 0.6F;
// Colours are taken from a pixel further in: a faint mixture spread over the whole bled zone would show as a line.
constexpr float kSource = 3.0F;  // [px]
// Blur of the bled zone: near the panel just enough to break up streaks, further out wide.
constexpr double kNearBlur = 1.6, kFarBlur = 6.0;  // [px]
constexpr float kFarStart = 4.0F, kFarEnd = 12.0F;

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
  return true;
}

/// Pixels that bleed: those out of the rim's reach, and the ridge of parts too thin to have any (straps).
cv::Mat find_sources(const cv::Mat& outside, const cv::Mat& depth) {
  cv::Mat ridge;
  cv::dilate(depth, ridge, cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));
  const cv::Mat sources = (depth > kSource) | ((depth >= ridge) & outside);
  return sources;
}

/// For every pixel of `wanted` != 0 the nearest non-zero pixel of `seeds`, as an index; -1 where there is none.
cv::Mat nearest(const cv::Mat& seeds, cv::Mat& distance) {
  cv::Mat labels, inverse = seeds == 0;
  cv::distanceTransform(inverse, distance, labels, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  int highest = 0;
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) highest = std::max(highest, labels.at<int>(y, x));
  std::vector<int> pixel(static_cast<std::size_t>(highest) + 1, -1);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      if (seeds.at<uchar>(y, x)) pixel[labels.at<int>(y, x)] = y * labels.cols + x;
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) labels.at<int>(y, x) = pixel[labels.at<int>(y, x)];
  return labels;
}

float brightness(const cv::Vec3f& c) {
  return 0.299F * c[0] + 0.587F * c[1] + 0.114F * c[2];
}

cv::Vec3b pixel_at(const cv::Mat& rgb, int index) {
  return rgb.at<cv::Vec3b>(index / rgb.cols, index % rgb.cols);
}

/// Marks the rim pixels whose colour lies on the way from the garment's to the board's, and those in the narrow shadow
/// between the cloth and the board: sewn together they would draw a dark line along every seam.
void drop_mixed(const cv::Mat& rgb, const cv::Mat& depth, const cv::Mat& garment, const cv::Mat& board, cv::Mat& keep) {
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) {
      if (!keep.at<uchar>(y, x) || depth.at<float>(y, x) > kRim) continue;
      const int inner = garment.at<int>(y, x), outer = board.at<int>(y, x);
      if (inner < 0 || inner == y * rgb.cols + x) continue;
      const cv::Vec3f base(pixel_at(rgb, inner)), own(rgb.at<cv::Vec3b>(y, x));
      if (brightness(own) < kShadow * brightness(base)) keep.at<uchar>(y, x) = 0;
      if (outer < 0) continue;
      const cv::Vec3f way = cv::Vec3f(pixel_at(rgb, outer)) - base, change = own - base;
      const float way2 = way.dot(way);
      // Board and garment of the same colour: a mixture shows nothing.
      if (way2 < 12.0F * 12.0F) continue;
      const float share = change.dot(way) / way2;
      // Off the way lies the garment's own piping or stitching.
      const cv::Vec3f beside = change - share * way;
      if (share > kMixed && beside.dot(beside) < 0.25F * share * share * way2 + 15.0F * 15.0F) keep.at<uchar>(y, x) = 0;
    }
}

/// Everything that is not kept takes the nearest source's colour, blurred more the further it lies.
void bleed(cv::Mat& rgb, const cv::Mat& keep, const cv::Mat& garment, const cv::Mat& distance) {
  cv::Mat filled = rgb.clone();
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x)
      if (!keep.at<uchar>(y, x)) filled.at<cv::Vec3b>(y, x) = pixel_at(rgb, garment.at<int>(y, x));
  cv::Mat close, far;
  cv::GaussianBlur(filled, close, {}, kNearBlur, kNearBlur, cv::BORDER_REPLICATE);
  cv::GaussianBlur(filled, far, {}, kFarBlur, kFarBlur, cv::BORDER_REPLICATE);
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) {
      if (keep.at<uchar>(y, x)) continue;
      const float t = std::clamp((distance.at<float>(y, x) - kFarStart) / (kFarEnd - kFarStart), 0.0F, 1.0F);
      const cv::Vec3f a(close.at<cv::Vec3b>(y, x)), b(far.at<cv::Vec3b>(y, x));
      const cv::Vec3f mix = a + t * (b - a);
      for (int c = 0; c < 3; ++c) rgb.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uchar>(mix[c]);
    }
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
  // 255 outside face, 0 anything else; `off` marks board and inside that lie clear of the rim.
  cv::Mat outside(size, CV_8UC1, cv::Scalar::all(0)), off = outside.clone();
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const int px = x + out.left, py = y + out.top;
      if (px < 0 || py < 0 || px >= width || py >= height) continue;
      const std::uint8_t* colour = source.rgb->at(px, py);
      out.rgb.at<cv::Vec3b>(y, x) = {colour[0], colour[1], colour[2]};
      const bool own = *source.labels->at(px, py) == label_outside;
      outside.at<uchar>(y, x) = own ? 255 : 0;
      off.at<uchar>(y, x) = own ? 0 : 255;
    }
  if (cv::countNonZero(outside) == 0)
    return Error{Cause::unusable, "NO_TEXTURE", "The panel covers no pixel of the garment in its photo.",
                 "Check the photo's mask, or let the garment be found without one.", "texture"};

  // A frame of nothing around it, so that a garment filling the crop has an edge as well.
  cv::Mat padded, depth;
  cv::copyMakeBorder(outside, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  cv::distanceTransform(padded, depth, cv::DIST_L2, cv::DIST_MASK_5);
  depth = depth(cv::Rect(cv::Point(1, 1), size)).clone();

  cv::Mat distance, board_distance, off_distance;
  const cv::Mat garment = nearest(find_sources(outside, depth), distance);
  cv::Mat not_outside = outside == 0, clear;
  cv::distanceTransform(not_outside, off_distance, cv::DIST_L2, cv::DIST_MASK_5);
  clear = (off_distance > kRim) & off;
  const cv::Mat board =
      cv::countNonZero(clear) ? nearest(clear, board_distance) : cv::Mat(size, CV_32SC1, cv::Scalar(-1));

  cv::Mat keep = outside.clone();
  drop_mixed(out.rgb, depth, garment, board, keep);
  bleed(out.rgb, keep, garment, distance);
  return out;
}

}  // namespace vitrine
