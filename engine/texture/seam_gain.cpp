// SPDX-License-Identifier: GPL-3.0-or-later
#include "seam_gain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace vitrine {
namespace {

constexpr int kSamplesPerEdge = 48;
constexpr double kInset = 0.008;         // [m] from the outline towards the panel, clear of the rim
constexpr double kLargestGain = 1.45;    // of linear light: half a stop, what two shots of one session differ by
constexpr double kLargestTint = 1.12;    // between channels: more is another colour, not another light
constexpr double kLargestSpread = 0.25;  // median deviation of the ratios: print differs
constexpr double kModeWidth = 0.15, kModeShare = 0.3;  // a ground colour: this share of the points within that of it
constexpr double kSmallestChange = 0.015;              // [-] below this the photo is left alone

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

/// The median, where half of the values lie within `spread` of it.
std::optional<double> steady_middle(const std::vector<double>& values, double spread) {
  const double middle = median(values);
  std::vector<double> deviation;
  for (const double v : values) deviation.push_back(std::abs(v / middle - 1.0));
  if (median(deviation) > spread) return std::nullopt;
  return middle;
}

/// The value around which a sample is densest, in shares (half-sample mode, Robertson and Cryer 1974), where enough of
/// the sample lies close to it.
std::optional<double> steady_mode(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  std::size_t first = 0, count = values.size();
  while (count > 2) {
    const std::size_t half = (count + 1) / 2;
    std::size_t best = first;
    for (std::size_t i = first; i + half <= first + count; ++i)
      if (values[i + half - 1] / values[i] < values[best + half - 1] / values[best]) best = i;
    first = best;
    count = half;
  }
  const double mode = 0.5 * (values[first] + values[first + count - 1]);
  const auto close =
      std::count_if(values.begin(), values.end(), [&](double v) { return std::abs(v / mode - 1.0) < kModeWidth; });
  if (static_cast<double>(close) < kModeShare * static_cast<double>(values.size())) return std::nullopt;
  return mode;
}

}  // namespace

std::array<double, 3> match_gain(std::span<const TextureSource> panels, std::vector<Cutout>& cuts) {
  const std::array<double, 3> none{1, 1, 1};
  const std::size_t front = panels[0].panel->side == Side::front ? 0 : 1, back = 1 - front;
  const Panel& a = *panels[front].panel;
  const Panel& b = *panels[back].panel;
  if (a.side == b.side || a.outline.size() < 3 || b.outline.size() < 3) return none;
  std::array<std::vector<double>, 3> ratios, fronts, backs;
  for (const PanelEdge& ea : a.edges)
    for (const PanelEdge& eb : b.edges) {
      if (ea.template_edge != eb.template_edge) continue;
      for (int i = 1; i < kSamplesPerEdge; ++i) {
        const double t = static_cast<double>(i) / kSamplesPerEdge;
        const auto ca = colour_at(a, cuts[front], ea, t), cb = colour_at(b, cuts[back], eb, t);
        if (!ca || !cb) continue;
        for (int c = 0; c < 3; ++c) {
          ratios[c].push_back((*ca)[c] / (*cb)[c]);
          fronts[c].push_back((*ca)[c]);
          backs[c].push_back((*cb)[c]);
        }
      }
    }
  if (ratios[0].size() < 20) return none;
  std::array<double, 3> gain{};
  for (int c = 0; c < 3; ++c) {
    auto found = steady_middle(ratios[c], kLargestSpread);
    if (!found) {
      // Where a print meets another part of it at the seam, points do not compare; the commonest colour still does.
      const auto front_ground = steady_mode(fronts[c]), back_ground = steady_mode(backs[c]);
      if (!front_ground || !back_ground) return none;
      found = *front_ground / *back_ground;
    }
    gain[c] = *found;
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
