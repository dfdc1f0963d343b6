// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "cutout.hpp"
#include "seam_gain.hpp"
#include "vitrine/texture.hpp"

namespace vitrine {
namespace {

constexpr int kSmallestSide = 512;  // [px], what shops ask for at least

/// Where each panel's picture lies in an atlas, in the order front, back.
struct Layout {
  int width = 0, height = 0, gutter = 0;
  std::vector<cv::Rect> cells;  // without gutter
  std::vector<cv::Rect> parts;  // of the atlas that belong to each; together they are the whole
  double worst = 0;             // smallest reduction factor, 1 = nothing is lost
};

/// Cells at a common density [px/m], one beside or below the other; a photo that is coarser keeps its own pixels.
/// Nothing where they do not fit.
std::optional<Layout> lay_out(std::span<const Cutout* const> cuts, double density, cv::Size size, int gutter,
                              bool below) {
  Layout l{size.width, size.height, gutter, {}, {}, 1.0};
  int at = 0;
  for (const Cutout* cut : cuts) {
    const double factor = std::min(1.0, density / cut->density);
    const cv::Rect cell(gutter + (below ? 0 : at), gutter + (below ? at : 0),
                        std::max(1, static_cast<int>(std::floor(cut->rgb.cols * factor))),
                        std::max(1, static_cast<int>(std::floor(cut->rgb.rows * factor))));
    if (cell.br().x + gutter > size.width || cell.br().y + gutter > size.height) return std::nullopt;
    const bool last = l.cells.size() + 1 == cuts.size();
    const int end = below ? (last ? size.height : cell.br().y + gutter) : (last ? size.width : cell.br().x + gutter);
    l.parts.push_back(below ? cv::Rect(0, at, size.width, end - at) : cv::Rect(at, 0, end - at, size.height));
    l.cells.push_back(cell);
    l.worst = std::min(l.worst, factor);
    at = end;
  }
  return l;
}

/// The smallest power of two that carries the photos as they are, else the largest allowed with the photos reduced.
Layout choose(std::span<const Cutout* const> cuts, const TextureOptions& options) {
  double finest = 0;
  for (const Cutout* cut : cuts) finest = std::max(finest, cut->density);
  std::vector<cv::Size> sizes;
  for (int side = kSmallestSide; side <= options.max_size; side *= 2) {
    if (side > kSmallestSide) {
      sizes.emplace_back(side, side / 2);
      sizes.emplace_back(side / 2, side);
    }
    sizes.emplace_back(side, side);
  }
  Layout best;
  for (const cv::Size& size : sizes)
    for (const bool below : {false, true}) {
      const int gutter =
          std::max(1, static_cast<int>(std::ceil(options.gutter * std::max(size.width, size.height) / 1024.0)));
      if (auto whole = lay_out(cuts, finest, size, gutter, below)) return *std::move(whole);
      // Bisection keeps to the densities that fit; 40 halvings are beyond a pixel at any size.
      double low = 0, high = finest;
      for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (lay_out(cuts, middle, size, gutter, below) ? low : high) = middle;
      }
      auto reduced = lay_out(cuts, low, size, gutter, below);
      if (reduced && reduced->worst > best.worst) best = *std::move(reduced);
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
    std::array<double, 3> gain{1, 1, 1};
    if (panels.size() == 2) gain = match_gain(panels, cuts);

    // The front comes first whatever the order of the panels.
    std::vector<std::size_t> order{0};
    if (panels.size() == 2)
      order = panels[1].panel->side < panels[0].panel->side ? std::vector<std::size_t>{1, 0}
                                                            : std::vector<std::size_t>{0, 1};
    std::vector<const Cutout*> ordered;
    for (const std::size_t k : order) ordered.push_back(&cuts[k]);
    const Layout layout = choose(ordered, options);
    if (layout.cells.empty())
      return Error{Cause::unusable, "TEXTURE_TOO_SMALL", "The photos do not fit into the largest texture allowed.",
                   "Allow a larger texture.", "texture"};
    Atlas atlas;
    atlas.rgb = Image(layout.width, layout.height, 3);
    atlas.uv.resize(panels.size());
    atlas.panels.resize(panels.size());
    cv::Mat canvas(layout.height, layout.width, CV_8UC3, atlas.rgb.data.data());
    for (std::size_t k = 0; k < order.size(); ++k) {
      const Cutout& cut = cuts[order[k]];
      const cv::Rect &cell = layout.cells[k], &part = layout.parts[k];
      cv::Mat scaled = cut.rgb;
      if (cell.size() != cut.rgb.size()) cv::resize(cut.rgb, scaled, cell.size(), 0, 0, cv::INTER_AREA);
      // The back panel was drawn in the front frame, mirrored; its picture is turned round again, as the camera took
      // it.
      const bool turned = panels[order[k]].panel->side == Side::back;
      if (turned) {
        cv::Mat other;
        cv::flip(scaled, other, 1);
        scaled = other;
      }
      // The cell's last colours run on to the neighbour and to the atlas' end, so that no mip level meets a black rim.
      cv::Mat filled;
      cv::copyMakeBorder(scaled, filled, cell.y - part.y, part.br().y - cell.br().y, cell.x - part.x,
                         part.br().x - cell.br().x, cv::BORDER_REPLICATE);
      filled.copyTo(canvas(part));

      const double fx = static_cast<double>(cell.width) / cut.rgb.cols;
      const double fy = static_cast<double>(cell.height) / cut.rgb.rows;
      for (const Vec2& p : cut.pixels) {
        const double across = (p.x() - cut.left + 0.5) * fx;
        atlas.uv[order[k]].emplace_back((cell.x + (turned ? cell.width - across : across)) / layout.width,
                                        (cell.y + (p.y() - cut.top + 0.5) * fy) / layout.height);
      }
      TextureFigures& figures = atlas.panels[order[k]];
      figures.print_share = cut.print_share;
      figures.filled_share = cut.filled_share;
      figures.scale = fx;
      if (turned) figures.gain = gain;
    }
    if (options.top_value < 255) ease_to(canvas, options.top_value);
    return atlas;
  } catch (const std::exception& e) {
    return Error{Cause::internal, "TEXTURE_FAILED", std::string("The texture could not be made: ") + e.what(),
                 "Report this with the photos that caused it.", "texture"};
  }
}

}  // namespace vitrine
