// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "boundary.hpp"
#include "cell_grid.hpp"

namespace vitrine::mesh_room {

/// The magnetic wall (paper III.B): the segments of outline and holes, cut into pieces no longer than about the target
/// edge so that the ones near a place are found in a cell grid.
class Wall {
 public:
  Wall(const Boundary& boundary, double edge_length);
  /// Distance to the nearest piece of wall; `limit` when none is nearer.
  double distance(const Vec2& p, double limit) const;

 private:
  struct Piece {
    Vec2 a, d;
    double inverse_square;  ///< 1 / |d|^2
  };
  double longest_ = 0;
  std::vector<Piece> pieces_;
  CellGrid grid_;
};

}  // namespace vitrine::mesh_room
