// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "vitrine/model/geometry.hpp"

namespace vitrine::mesh_room {

/// Points sorted into square cells, so that the neighbours of a place are found without looking at all points.
/// The cells grow when the box would need too many of them (long diagonal strips).
class CellGrid {
 public:
  /// The box [low, high] is fixed; points outside it are put into the border cells.
  CellGrid(const Vec2& low, const Vec2& high, double cell);
  /// Counting sort of the points; the order inside a cell is the order of the points.
  void fill(std::span<const Vec2> points);
  /// Calls visit(index) for every point in the cells that touch the square of half width `reach` around p.
  template <class Visit>
  void near(const Vec2& p, double reach, Visit&& visit) const {
    const int x0 = column(p.x() - reach), x1 = column(p.x() + reach);
    const int y0 = row(p.y() - reach), y1 = row(p.y() + reach);
    for (int y = y0; y <= y1; ++y) {
      const std::size_t line = static_cast<std::size_t>(y) * columns_;
      for (int i = start_[line + x0]; i < start_[line + x1 + 1]; ++i) visit(item_[i]);
    }
  }

 private:
  int column(double x) const { return clamp((x - low_.x()) / cell_, columns_); }
  int row(double y) const { return clamp((y - low_.y()) / cell_, rows_); }
  static int clamp(double v, int n) { return v <= 0 ? 0 : (v >= n ? n - 1 : static_cast<int>(v)); }

  Vec2 low_;
  double cell_;
  int columns_, rows_;
  std::vector<int> start_, item_;
};

}  // namespace vitrine::mesh_room
