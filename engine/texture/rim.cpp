// SPDX-License-Identifier: GPL-3.0-or-later
#include "rim.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace vitrine {
namespace {

// Lens blur, chroma subsampling and matting mix board and garment over this rim; chroma reaches furthest.
constexpr float kRim = 6.0F;  // [px]
// Where a second colour of the garment is looked for beside a rim pixel, and what makes it one.
constexpr int kNext = 6;         // [px]
constexpr double kOther = 25.0;  // [-] sRGB
// Within this much of the border a shadow under the edge counts as board.
constexpr float kShadowRim = 2.5F;  // [px]
// Where the outline was seen a little too wide, whole pixels of board follow; they go as deep as this.
constexpr float kDeepRim = 14.0F;      // [px]
constexpr float kMostlyBoard = 0.25F;  // share of the board from which a pixel this deep is taken for it
// Share of the board in a rim pixel from which it is taken for a mixture.
constexpr float kMixed = 0.08F;
// A rim pixel this much darker than the cloth behind it lies in the gap under the edge.
constexpr float kShadow = 0.6F;
// Colours to compare with are taken from beyond the rim.
constexpr float kClear = 7.0F;  // [px]
// Bled colours come from this far inside the border: a faint mixture spread over the whole bled zone would show as a
// line.
constexpr float kSource = 3.0F;  // [px]
// A pixel at the very border that is this far from all of the garment's colours around it belongs to the board.
constexpr int kAround = 6;         // [px]
constexpr double kUnlike = 12.0;   // [-] sRGB from which a mixture counts
constexpr double kStrange = 30.0;  // [-] sRGB
// Blur of the bled zone: near the panel just enough to break up streaks, further out wide.
constexpr double kNearBlur = 1.6, kFarBlur = 6.0;  // [px]
constexpr float kFarStart = 4.0F, kFarEnd = 12.0F;

float brightness(const cv::Vec3f& c) {
  return 0.299F * c[0] + 0.587F * c[1] + 0.114F * c[2];
}

cv::Vec3b pixel_at(const cv::Mat& rgb, int index) {
  return rgb.at<cv::Vec3b>(index / rgb.cols, index % rgb.cols);
}

/// Pixels deeper than `clear`, and the ridge of parts too thin to have any (straps).
cv::Mat deep_pixels(const cv::Mat& garment, const cv::Mat& depth, float clear) {
  cv::Mat ridge;
  const int reach = 2 * static_cast<int>(std::ceil(clear)) + 1;
  cv::dilate(depth, ridge, cv::getStructuringElement(cv::MORPH_RECT, {reach, reach}));
  const cv::Mat deep = (depth > clear) | ((depth >= ridge - 0.5) & garment);
  return deep;
}

/// Board colours with the noise averaged out, from clear of the border.
cv::Mat board_colours(const cv::Mat& rgb, const cv::Mat& off) {
  cv::Mat colour, weight, share;
  cv::Mat only = cv::Mat::zeros(rgb.size(), CV_8UC3);
  rgb.copyTo(only, off);
  cv::blur(only, colour, {5, 5});
  cv::blur(off, weight, {5, 5});
  cv::Mat result = rgb.clone();
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) {
      const int w = weight.at<uchar>(y, x);
      if (w < 8) continue;
      for (int c = 0; c < 3; ++c)
        result.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uchar>(colour.at<cv::Vec3b>(y, x)[c] * 255.0 / w);
    }
  return result;
}

/// Whether a colour is one of the garment's, or a mixture of two of them, with enough of the board in it.
bool is_mixture(const cv::Vec3f& own, const cv::Vec3f& base, const cv::Vec3f& other, const cv::Vec3f& board,
                float least = kMixed) {
  const cv::Vec3f way = board - base, change = own - base, across = other - base;
  const float way2 = way.dot(way), across2 = across.dot(across), both = way.dot(across);
  // Board and garment of the same colour: a mixture shows nothing.
  if (way2 < 12.0F * 12.0F) return false;
  float share = change.dot(way) / way2, along = 0;
  const float det = way2 * across2 - both * both;
  if (det > 0.02F * way2 * across2) {
    along = std::clamp((change.dot(across) * way2 - change.dot(way) * both) / det, 0.0F, 1.0F);
    share = (change - along * across).dot(way) / way2;
  }
  // Off the way lies the garment's own piping or stitching.
  const cv::Vec3f beside = change - share * way - along * across;
  return share > least && beside.dot(beside) < 0.25F * share * share * way2 + 15.0F * 15.0F;
}

/// The garment's colour most like a pixel's own, among `sources` around it.
struct Likeness {
  double difference = 1e9;  ///< [-] sRGB; as large as this where there are no sources
  cv::Vec3f colour;
};
/// `enough`: a difference that settles the question; what is still more alike is not looked for.
Likeness most_alike(const cv::Mat& rgb, const cv::Mat& sources, int x, int y, int reach, double enough) {
  const cv::Vec3b& own = rgb.at<cv::Vec3b>(y, x);
  const cv::Vec3b* colour = nullptr;
  const int settled = static_cast<int>(enough * enough);
  int best = 3 * 255 * 255 + 1;
  const int left = std::max(0, x - reach), right = std::min(rgb.cols - 1, x + reach);
  for (int v = std::max(0, y - reach); v <= std::min(rgb.rows - 1, y + reach) && best > settled; ++v) {
    const uchar* from = sources.ptr<uchar>(v);
    const cv::Vec3b* row = rgb.ptr<cv::Vec3b>(v);
    for (int u = left; u <= right; ++u) {
      if (!from[u]) continue;
      const int r = row[u][0] - own[0], g = row[u][1] - own[1], b = row[u][2] - own[2];
      const int squares = r * r + g * g + b * b;
      if (squares >= best) continue;
      best = squares;
      colour = &row[u];
    }
  }
  if (colour == nullptr) return {};
  return {std::sqrt(static_cast<double>(best)), cv::Vec3f(*colour)};
}

/// Whether none of the garment's own pixels around has such a colour, and the one most like it lies towards the board.
bool is_strange(const cv::Mat& rgb, const cv::Mat& sources, int x, int y, const cv::Vec3f& board) {
  const Likeness like = most_alike(rgb, sources, x, y, kAround, kStrange);
  const cv::Vec3f own(rgb.at<cv::Vec3b>(y, x));
  return like.difference < 1e9 && like.difference > kStrange && (own - like.colour).dot(board - like.colour) > 0;
}

}  // namespace

cv::Mat nearest_pixel(const cv::Mat& seeds, cv::Mat& distance) {
  cv::Mat labels, inverse = seeds == 0;
  cv::distanceTransform(inverse, distance, labels, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  // A label's own pixel is the seed at which it was given out.
  std::vector<int> pixel(static_cast<std::size_t>(cv::countNonZero(seeds)) + 1, -1);
  for (int y = 0; y < labels.rows; ++y) {
    const int* label = labels.ptr<int>(y);
    const uchar* seed = seeds.ptr<uchar>(y);
    for (int x = 0; x < labels.cols; ++x)
      if (seed[x]) pixel.at(static_cast<std::size_t>(label[x])) = y * labels.cols + x;
  }
  for (int y = 0; y < labels.rows; ++y) {
    int* label = labels.ptr<int>(y);
    for (int x = 0; x < labels.cols; ++x) label[x] = pixel.at(static_cast<std::size_t>(label[x]));
  }
  return labels;
}

void drop_rim(const cv::Mat& rgb, const cv::Mat& depth, const cv::Mat& off, cv::Mat& keep) {
  cv::Mat distance, off_distance;
  const cv::Mat clearly = deep_pixels(keep, depth, kClear), certain = deep_pixels(keep, depth, kDeepRim + 1);
  const cv::Mat garment = nearest_pixel(clearly, distance), deepest = nearest_pixel(certain, distance);
  cv::Mat not_garment = keep == 0;
  cv::distanceTransform(not_garment, off_distance, cv::DIST_L2, cv::DIST_MASK_5);
  const cv::Mat clear = (off_distance > 2.0) & off;
  const bool any = cv::countNonZero(clear) > 0;
  const cv::Mat board = any ? nearest_pixel(clear, distance) : cv::Mat(rgb.size(), CV_32SC1, cv::Scalar(-1));
  const cv::Mat smooth = any ? board_colours(rgb, clear) : rgb;
  const cv::Mat whole = keep.clone(), sources = deep_pixels(whole, depth, kSource);
  // From outside in: a pixel counts as mixed only if its neighbour further out is, so that the garment's own binding of
  // a colour between cloth and board stays.
  std::vector<std::pair<float, int>> order;
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x)
      if (whole.at<uchar>(y, x) && depth.at<float>(y, x) <= kDeepRim)
        order.emplace_back(depth.at<float>(y, x), y * rgb.cols + x);
  std::sort(order.begin(), order.end());
  for (const auto& [d, index] : order) {
    const int y = index / rgb.cols, x = index % rgb.cols;
    bool reached = d <= kShadowRim;
    for (int dy = -1; dy <= 1 && !reached; ++dy)
      for (int dx = -1; dx <= 1 && !reached; ++dx) {
        const int u = x + dx, v = y + dy;
        reached = u >= 0 && v >= 0 && u < rgb.cols && v < rgb.rows && whole.at<uchar>(v, u) && !keep.at<uchar>(v, u);
      }
    const int inner = garment.at<int>(y, x), outer = board.at<int>(y, x);
    if (!reached || inner < 0 || inner == index) continue;
    const cv::Vec3f base(pixel_at(rgb, inner)), own(rgb.at<cv::Vec3b>(y, x));
    if (d <= kShadowRim && brightness(own) < kShadow * brightness(base)) keep.at<uchar>(y, x) = 0;
    if (outer < 0) continue;
    const cv::Vec3f ground(pixel_at(smooth, outer));
    if (const int far = deepest.at<int>(y, x); far >= 0 && far != index) {
      const cv::Vec3f cloth(pixel_at(rgb, far));
      if (is_mixture(own, cloth, cloth, ground, kMostlyBoard) &&
          most_alike(rgb, certain, x, y, static_cast<int>(kDeepRim) + 3, kStrange).difference > kStrange)
        keep.at<uchar>(y, x) = 0;
    }
    if (d > kRim) continue;
    bool mixed = is_mixture(own, base, base, ground);
    // Between two stripes all three colours mix.
    for (const auto& [dx, dy] :
         {std::pair(kNext, 0), std::pair(-kNext, 0), std::pair(0, kNext), std::pair(0, -kNext)}) {
      const int u = x + dx, v = y + dy;
      if (mixed || u < 0 || v < 0 || u >= rgb.cols || v >= rgb.rows) continue;
      const cv::Vec3f other(pixel_at(rgb, garment.at<int>(v, u)));
      if (cv::norm(other - base) > kOther) mixed = is_mixture(own, base, other, ground);
    }
    // A stripe of a colour between cloth and board is no mixture: it goes on further in.
    if (mixed) mixed = most_alike(rgb, clearly, x, y, static_cast<int>(kClear) + 2, kUnlike).difference > kUnlike;
    if (!mixed && d <= kShadowRim) mixed = is_strange(rgb, sources, x, y, ground);
    if (mixed) keep.at<uchar>(y, x) = 0;
  }
}

void bleed(cv::Mat& rgb, const cv::Mat& keep, const cv::Mat& whole, const cv::Mat& depth) {
  cv::Mat distance;
  cv::Mat seeds = deep_pixels(whole, depth, kSource) & keep;
  if (cv::countNonZero(seeds) == 0) seeds = keep;
  const cv::Mat garment = nearest_pixel(seeds, distance);
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

}  // namespace vitrine
