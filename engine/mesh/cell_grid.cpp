// SPDX-License-Identifier: GPL-3.0-or-later
#include "cell_grid.hpp"

#include <algorithm>
#include <cmath>

namespace vitrine::mesh_room {

constexpr double kMaxCells = 1 << 21;

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

}  // namespace vitrine::mesh_room
