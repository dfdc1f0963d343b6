// SPDX-License-Identifier: GPL-3.0-or-later
#include "seam_gain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace vitrine {
namespace {

constexpr int kSamplesPerEdge = 24;
constexpr double kInset = 0.012;         // [m] from the outline towards the panel, clear of hem shadows
constexpr double kLargestGain = 0.12;    // what lighting explains
constexpr double kLargestRatio = 0.30;   // beyond this the cloth itself differs
constexpr double kLargestSpread = 0.12;  // median deviation of the ratios: print differs

/// Colour a little inside the outline, `t` of the way along an edge; mean of 5x5 pixels.
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
      for (int c = 0; c < 3; ++c) mean[c] += cut.rgb.at<cv::Vec3b>(y + dy, x + dx)[c] / 25.0;
  for (double v : mean)
    if (v < 16 || v > 252) return std::nullopt;  // no light to compare, or clipped
  return mean;
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

}  // namespace

void match_gain(std::span<const TextureSource> panels, std::vector<Cutout>& cuts) {
  const std::size_t front = panels[0].panel->side == Side::front ? 0 : 1, back = 1 - front;
  const Panel& a = *panels[front].panel;
  const Panel& b = *panels[back].panel;
  if (a.side == b.side || a.outline.size() < 3 || b.outline.size() < 3) return;
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
  if (ratios[0].size() < 20) return;
  std::array<double, 3> gain{};
  bool worth = false;
  for (int c = 0; c < 3; ++c) {
    const double middle = median(ratios[c]);
    std::vector<double> deviation;
    for (double r : ratios[c]) deviation.push_back(std::abs(r / middle - 1.0));
    if (std::abs(middle - 1.0) > kLargestRatio || median(deviation) > kLargestSpread) return;
    gain[c] = std::clamp(middle, 1.0 - kLargestGain, 1.0 + kLargestGain);
    worth = worth || std::abs(gain[c] - 1.0) > 0.01;
  }
  if (!worth) return;
  for (int y = 0; y < cuts[back].rgb.rows; ++y)
    for (int x = 0; x < cuts[back].rgb.cols; ++x) {
      cv::Vec3b& p = cuts[back].rgb.at<cv::Vec3b>(y, x);
      for (int c = 0; c < 3; ++c) p[c] = cv::saturate_cast<uchar>(p[c] * gain[c]);
    }
}

}  // namespace vitrine
