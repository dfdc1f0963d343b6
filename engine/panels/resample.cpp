// SPDX-License-Identifier: GPL-3.0-or-later
#include "resample.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vitrine::panels_room {
namespace {

constexpr double kSharpTurn = 40 * std::numbers::pi / 180;

double angle_between(const Vec2& a, const Vec2& b) {
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

}  // namespace

Curve::Curve(const std::vector<Vec2>& points, double window) : raw_(points), points_(points) {
  measure();
  std::vector<Vec2> smooth = points;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) smooth[i] = mean(arc_[i], window);
  points_ = std::move(smooth);
  measure();
}

void Curve::measure() {
  arc_.assign(1, 0.0);
  sum_.assign(1, Vec2::Zero());
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const double d = (points_[i] - points_[i - 1]).norm();
    arc_.push_back(arc_.back() + d);
    sum_.push_back(sum_.back() + 0.5 * d * (points_[i] + points_[i - 1]));
  }
}

std::size_t Curve::piece(double arc) const {
  const auto next = std::upper_bound(arc_.begin() + 1, arc_.end() - 1, arc);
  return static_cast<std::size_t>(next - arc_.begin()) - 1;
}

Vec2 Curve::at(double arc) const {
  const std::size_t i = piece(arc);
  const double d = arc_[i + 1] - arc_[i];
  return d > 0 ? Vec2(points_[i] + (points_[i + 1] - points_[i]) * std::clamp((arc - arc_[i]) / d, 0.0, 1.0))
               : points_[i];
}

Vec2 Curve::integral(double arc) const {
  const std::size_t i = piece(arc);
  return sum_[i] + 0.5 * (arc - arc_[i]) * (points_[i] + at(arc));
}

Vec2 Curve::mean(double arc, double half) const {
  half = std::min({half, arc, length() - arc});
  if (!(half > 1e-9 * length())) return at(arc);
  return (integral(arc + half) - integral(arc - half)) / (2 * half);
}

std::vector<Stop> Curve::sharp_corners(double spacing) const {
  const double reach = 0.5 * spacing, total = length();
  struct Corner {
    Stop stop;
    double turn;
  };
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const double s = arc_[i];
    if (s < spacing || s > total - spacing) continue;
    // Measured over a long and a short arm: a sharp corner turns nearly as much over the short one, a bow does not.
    const double wide = angle_between(points_[i] - at(s - reach), at(s + reach) - points_[i]);
    const double tight = angle_between(points_[i] - at(s - 0.4 * reach), at(s + 0.4 * reach) - points_[i]);
    if (wide > kSharpTurn && tight > 0.75 * wide) corners.push_back({{s, raw_[i]}, wide + tight});
  }
  std::stable_sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) { return a.turn > b.turn; });
  std::vector<Stop> chosen;
  for (const Corner& c : corners) {
    const auto near = [&](const Stop& s) { return std::abs(s.arc - c.stop.arc) < spacing; };
    if (std::none_of(chosen.begin(), chosen.end(), near)) chosen.push_back(c.stop);
  }
  std::sort(chosen.begin(), chosen.end(), [](const Stop& a, const Stop& b) { return a.arc < b.arc; });
  return chosen;
}

std::vector<Vec2> inner_nodes(const Curve& curve, int segments, const std::vector<Stop>& stops) {
  const int last = static_cast<int>(stops.size()) + 1;
  std::vector<Vec2> nodes;
  int used = 0;
  double start = 0;
  for (int k = 1; k <= last; ++k) {
    const double end = k == last ? curve.length() : stops[k - 1].arc;
    // Every stretch between stops gets at least one segment, and the sum stays exact.
    const int wanted = static_cast<int>(std::lround(segments * end / curve.length()));
    const int upto = k == last ? segments : std::clamp(wanted, used + 1, std::max(used + 1, segments - (last - k)));
    const double step = (end - start) / (upto - used);
    for (int i = 1; i < upto - used; ++i) nodes.push_back(curve.mean(start + i * step, 0.5 * step));
    if (k < last) nodes.push_back(stops[k - 1].position);
    used = upto;
    start = end;
  }
  return nodes;
}

}  // namespace vitrine::panels_room
