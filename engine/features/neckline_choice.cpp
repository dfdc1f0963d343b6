// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "neckline.hpp"

namespace vitrine::features_detail {

double neck_ratio(const cv::Mat& panel, const std::vector<Vec2>& neck_edge, Vec2& low) {
  if (neck_edge.size() < 2) return 0;
  const Vec2 along = (neck_edge.back() - neck_edge.front()).normalized(), down(-along.y(), along.x());
  const auto frame = [&](const Vec2& p) { return Vec2(p.dot(along), p.dot(down)); };
  Vec2 from = frame(neck_edge.front()), to = frame(neck_edge.back());
  low = neck_edge.front();
  for (const Vec2& p : neck_edge)
    if (frame(p).y() > frame(low).y()) low = p;
  // Of a flat bottom the middle is meant.
  const double flat = frame(low).y() - 0.01 * (neck_edge.back() - neck_edge.front()).norm();
  double first = 1e30, last = -1e30;
  for (const Vec2& p : neck_edge)
    if (frame(p).y() >= flat) first = std::min(first, frame(p).x()), last = std::max(last, frame(p).x());
  for (const Vec2& p : neck_edge)
    if (frame(p).y() >= flat &&
        std::abs(frame(p).x() - (first + last) / 2) < std::abs(frame(low).x() - (first + last) / 2))
      low = p;
  const double left = std::min(from.x(), to.x()), right = std::max(from.x(), to.x());
  const double top = std::min(from.y(), to.y()), bottom = frame(low).y();
  long foreground = 0, background = 0;
  for (double y = top + 0.5; y < bottom; y += 1)
    for (double x = left + 0.5; x < right; x += 1) {
      const Vec2 p = x * along + y * down;
      const int px = static_cast<int>(std::lround(p.x())), py = static_cast<int>(std::lround(p.y()));
      const bool garment = px >= 0 && py >= 0 && px < panel.cols && py < panel.rows && panel.at<uchar>(py, px) != 0;
      ++(garment ? foreground : background);
    }
  return background > 0 ? static_cast<double>(foreground) / static_cast<double>(background) : 0;
}

double tip_sharpness(const std::vector<Vec2>& edge) {
  if (edge.size() < 3) return 0;
  const Vec2 along = edge.back() - edge.front();
  const double width = along.norm();
  if (width <= 0) return 0;
  const Vec2 x = along / width, y(-x.y(), x.x());
  std::vector<Vec2> line;
  double depth = 0;
  for (const Vec2& p : edge) {
    line.emplace_back((p - edge.front()).dot(x) / width, (p - edge.front()).dot(y) / width);
    depth = std::max(depth, line.back().y());
  }
  if (depth <= 0) return 0;
  // The tip of a flat bottom is its middle.
  double first = 1, last = 0;
  for (const Vec2& p : line)
    if (p.y() > 0.97 * depth) {
      first = std::min(first, p.x());
      last = std::max(last, p.x());
    }
  const double tip = (first + last) / 2;
  if (tip <= 0.05 || tip >= 0.95) return 0;
  // How much of the rise to both sides happens near the tip, in units of a straight rise (a V). At this reach half an
  // ellipse has risen a third of it, while a square neck with round corners is still flat.
  constexpr double kReach = 0.3;
  const auto rise = [&](int step) {
    const double whole = step < 0 ? tip : 1 - tip, reach = std::min(kReach, 0.7 * whole);
    // A profile may be a few points only, so that the course between them counts.
    const double at = tip + step * reach;
    double height = depth;
    for (std::size_t i = 1; i < line.size(); ++i) {
      const Vec2 &a = line[i - 1], &b = line[i];
      if (a.x() == b.x() || (a.x() - at) * (b.x() - at) > 0) continue;
      height = std::min(height, depth - (a.y() + (b.y() - a.y()) * (at - a.x()) / (b.x() - a.x())));
    }
    return height / reach / (depth / whole);
  };
  return 0.5 * (rise(-1) + rise(1));
}

double relative_depth(const std::vector<Vec2>& edge) {
  if (edge.size() < 3) return 0;
  const Vec2 along = edge.back() - edge.front();
  double depth = 0;
  for (const Vec2& p : edge) {
    const Vec2 q = p - edge.front();
    depth = std::max(depth, (along.x() * q.y() - along.y() * q.x()) / along.squaredNorm());
  }
  return depth;
}

double choice_ratio(double ratio, const std::vector<Vec2>& edge) {
  if (edge.size() < 3) return ratio;
  const double depth = relative_depth(edge);
  constexpr double kArc = 1 - std::numbers::pi / 4;  // half ellipse: foreground share of its box
  const double trust = std::clamp((depth - 0.05) / 0.25, 0.0, 1.0);
  return trust * ratio + (1 - trust) * kArc / (1 - kArc);
}

int choose_neckline(std::span<const NecklineTemplate> necklines, double ratio, double sharpness, double depth) {
  // A back is shallow whatever its garment's neckline, and a front that is not seen may be as deep as fronts are.
  constexpr double kUsualDepth = 0.6;
  const auto too_deep = [&](const NecklineTemplate& n) {
    return std::abs(std::log((depth > 0 ? depth : kUsualDepth) / std::max(0.01, n.default_depth)));
  };
  // The ratio cannot tell necklines of one range from each other, a boat neck from a U: their depth does.
  const auto outdone = [&](const NecklineTemplate& n) {
    return std::any_of(necklines.begin(), necklines.end(), [&](const NecklineTemplate& other) {
      return other.ratio_min < n.ratio_max && n.ratio_min < other.ratio_max && too_deep(other) < too_deep(n);
    });
  };
  // Curved sides pull a V's ratio down and wrinkles push a U's up: near a border of two ranges the tip decides.
  constexpr double kUnsure = 1.5;
  int best = 0;
  double nearest = 1e30;
  for (int i = 0; i < static_cast<int>(necklines.size()); ++i) {
    const NecklineTemplate& n = necklines[i];
    if (outdone(n)) continue;
    const double gap = ratio < n.ratio_min    ? n.ratio_min - ratio
                       : ratio >= n.ratio_max ? ratio - n.ratio_max + 1e-12
                                              : 0;
    if (gap < nearest) {
      nearest = gap;
      best = i;
    }
  }
  int choice = best;
  // Sharpness is a ratio of slopes, so that it is compared as one; a square tip (0) counts as nearly flat, for even a
  // deep U with straight sides rises by an eighth of a V within the reach.
  constexpr double kFlat = 0.04;
  const auto miss_of = [&](const NecklineTemplate& n) {
    return std::abs(std::log(std::max(kFlat, tip_sharpness(n.profile)) / std::max(kFlat, sharpness)));
  };
  double closest = miss_of(necklines[best]);
  for (int i = 0; i < static_cast<int>(necklines.size()); ++i) {
    const NecklineTemplate& n = necklines[i];
    if (i == best || outdone(n) || ratio <= 0 || ratio * kUnsure < n.ratio_min || ratio > n.ratio_max * kUnsure)
      continue;
    const double over = std::max(1.0, std::max(n.ratio_min / ratio, ratio / n.ratio_max));
    const double miss = miss_of(n) + 2 * std::log(over);  // the further over the border, the clearer the tip has to be
    if (miss < closest) {
      closest = miss;
      choice = i;
    }
  }
  return choice;
}

}  // namespace vitrine::features_detail
