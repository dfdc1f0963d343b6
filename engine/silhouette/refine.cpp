// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "picture.hpp"

namespace vitrine {
namespace {

constexpr int tile = 32;           ///< [px of the picture]
constexpr float half_trust = 100;  ///< squared colour distance of both sides at which the colour has half the say

/// The tile's pixels near the contour, gathered so that only they are converted to Lab.
struct Band {
  std::vector<cv::Point> at;     ///< in the tile
  std::vector<cv::Point> rough;  ///< nearest pixel of the rough mask
  std::vector<float> before;     ///< smoothed rough mask, 0..255
  std::vector<cv::Vec3b> colours;
  void clear() {
    at.clear();
    rough.clear();
    before.clear();
    colours.clear();
  }
};

/// Coverage of the picture's pixels in `box`, into `soft`. `band` is scratch. False when all of them lie on one side.
bool cover_tile(const cv::Mat& rgb, const cv::Rect& box, const cv::Mat& rough, const cv::Mat& prior, const Sides& sides,
                Band& band, cv::Mat& soft) {
  const float sx = static_cast<float>(rough.cols) / static_cast<float>(rgb.cols),
              sy = static_cast<float>(rough.rows) / static_cast<float>(rgb.rows);
  soft.create(box.size(), CV_8U);
  band.clear();
  for (int y = 0; y < box.height; ++y) {
    const float v =
        std::clamp((static_cast<float>(box.y + y) + 0.5f) * sy - 0.5f, 0.0f, static_cast<float>(rough.rows - 1));
    const int v0 = static_cast<int>(v), v1 = std::min(v0 + 1, rough.rows - 1);
    const float fv = v - static_cast<float>(v0);
    const std::uint8_t *top = prior.ptr(v0), *bottom = prior.ptr(v1);
    std::uint8_t* out = soft.ptr(y);
    const cv::Vec3b* colour = rgb.ptr<cv::Vec3b>(box.y + y) + box.x;
    for (int x = 0; x < box.width; ++x) {
      const float u =
          std::clamp((static_cast<float>(box.x + x) + 0.5f) * sx - 0.5f, 0.0f, static_cast<float>(rough.cols - 1));
      const int u0 = static_cast<int>(u), u1 = std::min(u0 + 1, rough.cols - 1);
      const float fu = u - static_cast<float>(u0);
      const float before =
          (1 - fv) * ((1 - fu) * top[u0] + fu * top[u1]) + fv * ((1 - fu) * bottom[u0] + fu * bottom[u1]);
      out[x] = before < 128 ? 0 : 255;
      if (before < 12 || before > 243) continue;
      band.at.emplace_back(x, y);
      band.rough.emplace_back(fu < 0.5f ? u0 : u1, fv < 0.5f ? v0 : v1);
      band.before.push_back(before);
      band.colours.push_back(colour[x]);
    }
  }
  if (band.at.empty()) return false;
  const cv::Mat lab = lab_from_rgb(cv::Mat(1, static_cast<int>(band.at.size()), CV_8UC3, band.colours.data()));
  const cv::Vec3f* seen = lab.ptr<cv::Vec3f>();
  for (std::size_t i = 0; i < band.at.size(); ++i) {
    const cv::Point r = band.rough[i];
    std::uint8_t& out = soft.at<std::uint8_t>(band.at[i]);
    // Narrow straps and gaps have no sure pixels of one side nearby; there the rough mask is all there is.
    if (sides.weight_in.at<float>(r) < 0.01f || sides.weight_out.at<float>(r) < 0.01f) {
      out = rough.at<std::uint8_t>(r);
      continue;
    }
    const cv::Vec3f in = sides.in.at<cv::Vec3f>(r), ground = sides.out.at<cv::Vec3f>(r);
    const float apart = distance2(in, ground);
    const float along = apart > 1e-6f ? (seen[i] - ground).dot(in - ground) / apart : 0.5f;
    const float share = std::clamp(along, 0.0f, 1.0f);
    // What mixes neither side's colour (shade, a print, a thread) says less about the side.
    const float strange = distance2(seen[i], ground + share * (in - ground));
    const float trust = 0.75f * apart / (apart + half_trust + 2 * strange);
    out = static_cast<std::uint8_t>(trust * 255 * share + (1 - trust) * band.before[i] + 0.5f);
  }
  return true;
}

}  // namespace

cv::Mat refine_contour(const cv::Mat& rgb, const cv::Mat& rough, const Sides& sides) {
  cv::Mat prior, near, far, soft;
  cv::GaussianBlur(rough, prior, {}, 0.8 * contour_reach);
  // The reach of the blurred prior and of the last smoothing; beyond, a tile is all garment or all ground.
  const int around = 2 * contour_reach + 1;
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_RECT, {2 * around + 1, 2 * around + 1});
  cv::erode(rough, near, kernel, {-1, -1}, 1, cv::BORDER_REPLICATE);
  cv::dilate(rough, far, kernel);
  const double scale = static_cast<double>(rgb.cols) / rough.cols, sigma = std::max(0.7, 0.5 * scale);
  const int margin = static_cast<int>(std::ceil(2 * sigma));
  const cv::Size window(2 * margin + 1, 2 * margin + 1);
  cv::Mat out(rgb.size(), CV_8U);
  Band band;
  const cv::Rect whole({}, rgb.size());
  for (int y = 0; y < rgb.rows; y += tile)
    for (int x = 0; x < rgb.cols; x += tile) {
      const cv::Rect box = cv::Rect(x, y, tile, tile) & whole;
      const cv::Point middle(std::min(rough.cols - 1, static_cast<int>((x + box.width / 2) / scale)),
                             std::min(rough.rows - 1, static_cast<int>((y + box.height / 2) / scale)));
      const int half = static_cast<int>(std::ceil(0.5 * tile / scale)) + 1;
      const cv::Rect seen =
          cv::Rect(middle.x - half, middle.y - half, 2 * half + 1, 2 * half + 1) & cv::Rect({}, rough.size());
      const int inside = cv::countNonZero(near(seen)), touched = cv::countNonZero(far(seen));
      if (inside == seen.area() || touched == 0) {
        out(box).setTo(inside ? 255 : 0);
        continue;
      }
      const cv::Rect wide = cv::Rect(x - margin, y - margin, box.width + 2 * margin, box.height + 2 * margin) & whole;
      if (cover_tile(rgb, wide, rough, prior, sides, band, soft))
        cv::GaussianBlur(soft, soft, window, sigma, sigma, cv::BORDER_REPLICATE);
      soft(box - wide.tl()).copyTo(out(box));
    }
  return out;
}

}  // namespace vitrine
