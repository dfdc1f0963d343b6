// SPDX-License-Identifier: GPL-3.0-or-later
#include "limb.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vitrine {
namespace {

/// The outline between two corners, both included, on the side that does not pass `avoid`.
std::vector<Vec2> along_outline(const Panel& panel, int from, int to, int avoid) {
  const int n = static_cast<int>(panel.outline.size());
  for (const int step : {1, n - 1}) {
    std::vector<Vec2> line{panel.outline[from]};
    bool clear = true;
    for (int i = from; i != to && clear;) {
      i = (i + step) % n;
      clear = i != avoid;
      line.push_back(panel.outline[i]);
    }
    if (clear) return line;
  }
  return {};
}

/// `count` + 1 points at equal arc length.
std::vector<Vec2> evenly(const std::vector<Vec2>& line, int count) {
  std::vector<double> arc{0};
  for (std::size_t i = 1; i < line.size(); ++i) arc.push_back(arc.back() + (line[i] - line[i - 1]).norm());
  std::vector<Vec2> even;
  std::size_t k = 1;
  for (int i = 0; i <= count; ++i) {
    const double s = arc.back() * i / count;
    while (k + 1 < line.size() && arc[k] < s) ++k;
    const double piece = std::max(1e-12, arc[k] - arc[k - 1]);
    even.push_back(line[k - 1] + (line[k] - line[k - 1]) * std::clamp((s - arc[k - 1]) / piece, 0.0, 1.0));
  }
  return even;
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  const double t = std::clamp((p - a).dot(d) / std::max(1e-18, d.squaredNorm()), 0.0, 1.0);
  return (p - a - t * d).norm();
}

/// Inside the polygon or on its border (the panel's own outline nodes lie exactly on it).
bool belongs(const Vec2& p, const std::vector<Vec2>& polygon) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 &a = polygon[i], &b = polygon[j];
    if (distance_to_segment(p, a, b) < 1e-7) return true;
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
      inside = !inside;
  }
  return inside;
}

Vec2 left_of(const Vec2& t) {
  return {-t.y(), t.x()};
}

}  // namespace

Polyline::Polyline(std::vector<Vec2> points) : points_(std::move(points)) {
  arc_.push_back(0);
  for (std::size_t i = 1; i < points_.size(); ++i) arc_.push_back(arc_.back() + (points_[i] - points_[i - 1]).norm());
}

Vec2 Polyline::at(double s, Vec2& tangent) const {
  std::size_t k = 1;
  while (k + 1 < points_.size() && arc_[k] < s) ++k;
  const double piece = std::max(1e-12, arc_[k] - arc_[k - 1]);
  tangent = (points_[k] - points_[k - 1]) / piece;
  return points_[k - 1] + tangent * (s - arc_[k - 1]);
}

void Polyline::project(const Vec2& p, double& s, double& offset) const {
  double best = std::numeric_limits<double>::max();
  for (std::size_t k = 1; k < points_.size(); ++k) {
    const double piece = std::max(1e-12, arc_[k] - arc_[k - 1]);
    const Vec2 t = (points_[k] - points_[k - 1]) / piece;
    double along = (p - points_[k - 1]).dot(t);
    if (k > 1) along = std::max(along, 0.0);
    if (k + 1 < points_.size()) along = std::min(along, piece);
    const double d = (p - points_[k - 1] - along * t).squaredNorm();
    if (d < best) {
      best = d;
      s = arc_[k - 1] + along;
      offset = (p - points_[k - 1]).dot(left_of(t));
    }
  }
}

Result<LimbBend> LimbBend::make(const TemplateLimb& limb, const Panel& panel, const Mannequin& mannequin,
                                const Vec2& shift) {
  std::vector<Vec2> chain;
  for (const std::string& name : limb.chain) {
    const auto found = mannequin.landmarks.find(name);
    if (found == mannequin.landmarks.end())
      return Error{Cause::unusable, "NO_LANDMARK",
                   "the mannequin has no landmark \"" + name + "\" that limb \"" + limb.name + "\" follows",
                   "use another mannequin, or correct the limb's chain in the garment plugin", "fit"};
    chain.push_back(found->second.head<2>());
  }
  const int root_a = panel.corner[limb.root_a], root_b = panel.corner[limb.root_b];
  const int tip_a = panel.corner[limb.tip_a], tip_b = panel.corner[limb.tip_b];
  const auto side_a = along_outline(panel, root_a, tip_a, root_b);
  const auto side_b = along_outline(panel, root_b, tip_b, root_a);
  if (chain.size() < 2 || side_a.empty() || side_b.empty())
    return Error{Cause::plugin, "BAD_LIMB", "limb \"" + limb.name + "\" does not run along the panel's outline",
                 "correct the limb's root and tip features in the garment plugin", "fit"};
  constexpr int pieces = 10;
  const auto even_a = evenly(side_a, pieces), even_b = evenly(side_b, pieces);
  std::vector<Vec2> middle, region;
  for (int i = 0; i <= pieces; ++i) middle.push_back((even_a[i] + even_b[i]) / 2 + shift);
  for (const Vec2& q : side_a) region.push_back(q + shift);
  const auto cuff = along_outline(panel, tip_a, tip_b, root_b);
  for (std::size_t i = 1; i + 1 < cuff.size(); ++i) region.push_back(cuff[i] + shift);
  for (std::size_t i = side_b.size(); i-- > 0;) region.push_back(side_b[i] + shift);
  Polyline flat(std::move(middle)), body(std::move(chain));
  double start = 0, ignored = 0;
  Vec2 tangent;
  body.project(flat.at(0, tangent), start, ignored);
  const Vec2 a = region.front(), b = region.back();
  const double blend = std::clamp(0.5 * (a - b).norm(), 0.02, 0.12);
  return LimbBend(std::move(flat), std::move(body), std::move(region), a, b, std::max(0.0, start), blend);
}

Vec2 LimbBend::operator()(const Vec2& placed) const {
  if (!belongs(placed, region_)) return placed;
  const double t = std::clamp(distance_to_segment(placed, root_a_, root_b_) / blend_, 0.0, 1.0);
  const double weight = t * t * (3 - 2 * t);
  double s = 0, offset = 0;
  flat_.project(placed, s, offset);
  Vec2 tangent;
  const Vec2 on_body = body_.at(body_start_ + s, tangent);
  return placed + weight * (on_body + offset * left_of(tangent) - placed);
}

}  // namespace vitrine
