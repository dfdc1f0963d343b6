// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "cutout.hpp"
#include "seam_gain.hpp"
#include "vitrine/texture.hpp"

namespace vitrine {
namespace {

constexpr int kSmallestSide = 512;  // [px], what shops ask for at least

/// Sizes of the two cells in an atlas and the factor each panel's photo is reduced by.
struct Layout {
  int width = 0, height = 0, gutter = 0;
  std::vector<cv::Size> cells;  // without gutter
  double worst = 0;             // smallest reduction factor, 1 = nothing is lost
};

int gutter_of(const TextureOptions& options, int width) {
  return std::max(1, static_cast<int>(std::ceil(options.gutter * width / 1024.0)));
}

/// Cells at a common density [px/m]; a photo that is coarser than that keeps its own pixels.
Layout lay_out(const std::vector<Cutout>& cuts, double density, int width, int height, int gutter) {
  Layout l{width, height, gutter, {}, 1.0};
  for (const Cutout& cut : cuts) {
    const double factor = std::min(1.0, density / cut.density);
    l.cells.emplace_back(std::max(1, static_cast<int>(std::floor(cut.rgb.cols * factor))),
                         std::max(1, static_cast<int>(std::floor(cut.rgb.rows * factor))));
    l.worst = std::min(l.worst, factor);
  }
  return l;
}

bool fits(const Layout& l) {
  int width = 0, height = 0;
  for (const cv::Size& cell : l.cells) {
    width += cell.width + 2 * l.gutter;
    height = std::max(height, cell.height + 2 * l.gutter);
  }
  return width <= l.width && height <= l.height;
}

/// The smallest power of two that carries the photos as they are, else the largest allowed with the photos reduced.
Layout choose(const std::vector<Cutout>& cuts, const TextureOptions& options) {
  double finest = 0;
  for (const Cutout& cut : cuts) finest = std::max(finest, cut.density);
  Layout best;
  for (int width = kSmallestSide; width <= options.max_size; width *= 2)
    for (int height : {width / 2, width}) {
      if (height < kSmallestSide) continue;
      const int gutter = gutter_of(options, width);
      Layout l = lay_out(cuts, finest, width, height, gutter);
      if (fits(l)) return l;
      // Bisection keeps to the densities that fit; 40 halvings are beyond a pixel at any size.
      double low = 0, high = finest;
      for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (fits(lay_out(cuts, middle, width, height, gutter)) ? low : high) = middle;
      }
      l = lay_out(cuts, low, width, height, gutter);
      if (fits(l) && l.worst > best.worst) best = l;
    }
  return best;
}

/// Brightens nothing and clips nothing: above a knee the brightest channel eases towards `top` with a slope that
/// starts at 1, and all channels shrink by the same factor, so hues stay.
void ease_to(cv::Mat& rgb, int top) {
  std::array<double, 256> factor{};
  const double knee = std::max(0.0, 255.0 - 3.0 * (255 - top));
  const double ratio = (top - knee) / (255.0 - knee);
  for (int v = 0; v < 256; ++v) {
    const double t = (v - knee) / (255.0 - knee);
    double mapped = v;
    if (knee <= 0)
      mapped = v * top / 255.0;
    else if (v > knee)
      mapped = knee + (255.0 - knee) * (t - (1.0 - ratio) * t * t);
    factor[v] = v ? mapped / v : 1.0;
  }
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) {
      cv::Vec3b& p = rgb.at<cv::Vec3b>(y, x);
      const double f = factor[std::max({p[0], p[1], p[2]})];
      for (int c = 0; c < 3; ++c) p[c] = cv::saturate_cast<uchar>(p[c] * f);
    }
}

}  // namespace

Result<Atlas> make_atlas(std::span<const TextureSource> panels, const TextureOptions& options) {
  if (panels.empty() || panels.size() > 2)
    return Error{Cause::internal, "BAD_TEXTURE_SOURCE", "An atlas takes one or two panels.", "Report this.", "texture"};
  if (options.max_size < kSmallestSide || options.max_size > 8192 || options.gutter < 0 || options.gutter > 64 ||
      options.top_value < 64 || options.top_value > 255)
    return Error{Cause::usage, "BAD_TEXTURE_OPTIONS", "The texture's size, gutter or top value is out of range.",
                 "Use max_size 512 to 8192, gutter 0 to 64 and top_value 64 to 255.", "texture"};
  try {
    std::vector<Cutout> cuts;
    for (const TextureSource& panel : panels) {
      // The margin feeds the area filter and the bilinear taps at the panel's edge; the gutter proper is added later.
      auto cut = cut_out(panel, 4);
      if (!cut) return cut.error();
      cuts.push_back(std::move(*cut));
    }
    if (panels.size() == 2) match_gain(panels, cuts);

    const Layout layout = choose(cuts, options);
    if (layout.cells.empty())
      return Error{Cause::unusable, "TEXTURE_TOO_SMALL", "The photos do not fit into the largest texture allowed.",
                   "Allow a larger texture.", "texture"};
    // The front photo lies on the left whatever the order of the panels.
    std::vector<std::size_t> order{0};
    if (panels.size() == 2)
      order = panels[1].panel->side < panels[0].panel->side ? std::vector<std::size_t>{1, 0}
                                                            : std::vector<std::size_t>{0, 1};
    Atlas atlas;
    atlas.rgb = Image(layout.width, layout.height, 3);
    atlas.uv.resize(panels.size());
    cv::Mat canvas(layout.height, layout.width, CV_8UC3, atlas.rgb.data.data());
    int left = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
      const Cutout& cut = cuts[order[k]];
      const cv::Size cell = layout.cells[order[k]];
      cv::Mat scaled;
      if (cell == cut.rgb.size())
        scaled = cut.rgb;
      else
        cv::resize(cut.rgb, scaled, cell, 0, 0, cv::INTER_AREA);
      // The cell's last colours run on to the neighbour and to the atlas' end, so that no mip level meets a black rim.
      const int strip = k + 1 == order.size() ? layout.width - left : cell.width + 2 * layout.gutter;
      cv::Mat filled;
      cv::copyMakeBorder(scaled, filled, layout.gutter, layout.height - layout.gutter - cell.height, layout.gutter,
                         strip - layout.gutter - cell.width, cv::BORDER_REPLICATE);
      filled.copyTo(canvas(cv::Rect(left, 0, strip, layout.height)));

      const double fx = static_cast<double>(cell.width) / cut.rgb.cols;
      const double fy = static_cast<double>(cell.height) / cut.rgb.rows;
      for (const Vec2& p : cut.pixels)
        atlas.uv[order[k]].emplace_back((left + layout.gutter + (p.x() - cut.left + 0.5) * fx) / layout.width,
                                        (layout.gutter + (p.y() - cut.top + 0.5) * fy) / layout.height);
      left += strip;
    }
    ease_to(canvas, options.top_value);
    return atlas;
  } catch (const std::exception& e) {
    return Error{Cause::internal, "TEXTURE_FAILED", std::string("The texture could not be made: ") + e.what(),
                 "Report this with the photos that caused it.", "texture"};
  }
}

}  // namespace vitrine
