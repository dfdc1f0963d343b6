// SPDX-License-Identifier: GPL-3.0-or-later
#include "wall.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vitrine::mesh_room {
namespace {

constexpr double kMaxCells = 1 << 21;

Vec2 lowest(std::span<const Vec2> points) {
  Vec2 low = points.front();
  for (const Vec2& p : points) low = low.cwiseMin(p);
  return low;
}

Vec2 highest(std::span<const Vec2> points) {
  Vec2 high = points.front();
  for (const Vec2& p : points) high = high.cwiseMax(p);
  return high;
}

}  // namespace

CellGrid::CellGrid(const Vec2& low, const Vec2& high, double cell) : low_(low), cell_(cell) {
  const Vec2 size = (high - low).cwiseMax(Vec2(cell, cell));
  cell_ = std::max({cell, std::sqrt(size.x() / kMaxCells * size.y()), size.maxCoeff() / kMaxCells});
  columns_ = static_cast<int>(size.x() / cell_) + 1;
  rows_ = static_cast<int>(size.y() / cell_) + 1;
  start_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
}

void CellGrid::fill(std::span<const Vec2> points) {
  std::fill(start_.begin(), start_.end(), 0);
  std::vector<std::size_t> cell(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    cell[i] = static_cast<std::size_t>(row(points[i].y())) * columns_ + column(points[i].x());
    ++start_[cell[i] + 1];
  }
  for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
  item_.resize(points.size());
  std::vector<int> next(start_.begin(), start_.end() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) item_[next[cell[i]]++] = static_cast<int>(i);
}

Wall::Wall(std::span<const Vec2> outline, double edge_length)
    : low_(lowest(outline)),
      high_(highest(outline)),
      magnets_(outline.begin(), outline.end()),
      grid_(low_, high_, 1.5 * edge_length) {
  const std::size_t n = outline.size();
  double turn = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = outline[i] - outline[0], b = outline[(i + 1) % n] - outline[0];
    turn += a.x() * b.y() - a.y() * b.x();
  }
  const auto normal = [&](std::size_t i) {
    const Vec2 d = outline[(i + 1) % n] - outline[i];
    return turn > 0 ? Vec2(-d.y(), d.x()) : Vec2(d.y(), -d.x());
  };
  for (std::size_t i = 0; i < n; ++i) inward_.push_back({normal((i + n - 1) % n), normal(i)});
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % n];
    const double length = (b - a).norm();
    // A segment may be a third longer than the target before the gap between its ends lets a node slip through.
    const int parts = std::max(1, static_cast<int>(std::ceil(length / (1.3 * edge_length))));
    for (int k = 0; k < parts; ++k) {
      const Vec2 p = a + (b - a) * (static_cast<double>(k) / parts);
      const Vec2 q = k + 1 == parts ? b : Vec2(a + (b - a) * (static_cast<double>(k + 1) / parts));
      if (k > 0) {
        magnets_.push_back(p);
        inward_.push_back({normal(i), normal(i)});
      }
      pieces_.push_back({p, q});
      middles_.push_back(0.5 * (p + q));
      longest_ = std::max(longest_, length / parts);
    }
  }
  grid_.fill(middles_);
}

double Wall::distance(const Vec2& p, double limit, Vec2* away) const {
  double best = limit * limit;
  Vec2 offset = Vec2::Zero();
  grid_.near(p, limit + 0.5 * longest_, [&](int i) {
    const Piece& piece = pieces_[i];
    const Vec2 d = piece.b - piece.a;
    const double t = std::clamp((p - piece.a).dot(d) / d.squaredNorm(), 0.0, 1.0);
    const Vec2 o = p - piece.a - t * d;
    const double squared = o.squaredNorm();
    if (squared < best) {
      best = squared;
      offset = o;
    }
  });
  const double r = std::sqrt(best);
  if (away != nullptr) *away = r > 0 ? Vec2(offset / r) : Vec2::Zero();
  return r;
}

}  // namespace vitrine::mesh_room
