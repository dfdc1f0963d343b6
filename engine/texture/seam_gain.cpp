// SPDX-License-Identifier: GPL-3.0-or-later
#include "seam_gain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace vitrine {
namespace {

constexpr int kSamplesPerEdge = 48;
constexpr double kInset = 0.008;           // [m] from the outline towards the panel, clear of the rim
constexpr double kLargestGain = 1.45;      // of linear light: half a stop, what two shots of one session differ by
constexpr double kLargestTint = 1.12;      // between channels: more is another colour, not another light
constexpr double kLargestSpread = 0.25;    // median deviation of the ratios: print differs
constexpr double kSmallestChange = 0.015;  // [-] below this the photo is left alone

double linear(double v) {
  const double c = v / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double encoded(double c) {
  return 255.0 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
}

/// Linear light a little inside the outline, `t` of the way along an edge; mean of 5x5 pixels.
std::optional<std::array<double, 3>> colour_at(const Panel& panel, const Cutout& cut, const PanelEdge& edge, double t) {
  const int n = static_cast<int>(panel.outline.size());
  const int span = ((edge.last - edge.first) % n + n) % n;
  const int at = (edge.first + static_cast<int>(std::lround(t * span))) % n;
  const Vec2 along = panel.outline[(at + 1) % n] - panel.outline[(at + n - 1) % n];
  if (along.norm() < 1e-9) return std::nullopt;
  // The outline runs counter-clockwise, so its left is the panel.
  const Vec2 inward = Vec2(-along.y(), along.x()).normalized();
  const Vec2 p = panel.pixel_from_panel(panel.outline[at] + kInset * inward);
  const int x = static_cast<int>(std::lround(p.x())) - cut.left, y = static_cast<int>(std::lround(p.y())) - cut.top;
  if (x < 2 || y < 2 || x + 2 >= cut.rgb.cols || y + 2 >= cut.rgb.rows) return std::nullopt;
  std::array<double, 3> mean{};
  for (int dy = -2; dy <= 2; ++dy)
    for (int dx = -2; dx <= 2; ++dx)
      for (int c = 0; c < 3; ++c) mean[c] += linear(cut.rgb.at<cv::Vec3b>(y + dy, x + dx)[c]) / 25.0;
  for (double v : mean)
    if (v < 0.004 || v > 0.96) return std::nullopt;  // no light to compare, or clipped
  return mean;
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

}  // namespace

std::array<double, 3> match_gain(std::span<const TextureSource> panels, std::vector<Cutout>& cuts) {
  const std::array<double, 3> none{1, 1, 1};
  const std::size_t front = panels[0].panel->side == Side::front ? 0 : 1, back = 1 - front;
  const Panel& a = *panels[front].panel;
  const Panel& b = *panels[back].panel;
  if (a.side == b.side || a.outline.size() < 3 || b.outline.size() < 3) return none;
  std::array<std::vector<double>, 3> ratios;
  for (const PanelEdge& ea : a.edges)
    for (const PanelEdge& eb : b.edges) {
      if (ea.template_edge != eb.template_edge) continue;
      for (int i = 1; i < kSamplesPerEdge; ++i) {
        const double t = static_cast<double>(i) / kSamplesPerEdge;
        const auto ca = colour_at(a, cuts[front], ea, t), cb = colour_at(b, cuts[back], eb, t);
        if (!ca || !cb) continue;
        for (int c = 0; c < 3; ++c) ratios[c].push_back((*ca)[c] / (*cb)[c]);
      }
    }
  if (ratios[0].size() < 20) return none;
  std::array<double, 3> gain{};
  for (int c = 0; c < 3; ++c) {
    gain[c] = median(ratios[c]);
    std::vector<double> deviation;
    for (double r : ratios[c]) deviation.push_back(std::abs(r / gain[c] - 1.0));
    if (median(deviation) > kLargestSpread) return none;
  }
  const auto [low, high] = std::minmax_element(gain.begin(), gain.end());
  if (*high > kLargestGain || *low < 1.0 / kLargestGain || *high / *low > kLargestTint) return none;
  if (std::max(*high - 1.0, 1.0 - *low) < kSmallestChange) return none;
  std::array<std::array<uchar, 256>, 3> table;
  for (int c = 0; c < 3; ++c)
    for (int v = 0; v < 256; ++v) table[c][v] = cv::saturate_cast<uchar>(encoded(std::min(1.0, gain[c] * linear(v))));
  cv::Mat& rgb = cuts[back].rgb;
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x)
      for (int c = 0; c < 3; ++c) {
        uchar& v = rgb.at<cv::Vec3b>(y, x)[c];
        v = table[c][v];
      }
  return gain;
}

}  // namespace vitrine
