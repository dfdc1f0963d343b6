// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "boundary.hpp"
#include "cell_grid.hpp"

namespace vitrine::mesh_room {

/// The magnetic wall (paper III.B): the segments of outline and holes, cut into pieces no longer than about the target
/// edge so that the ones near a place are found in a cell grid. Refers to
/// the boundary it was made from.
class Wall {
 public:
  Wall(const Boundary& boundary, double edge_length);
  struct Nearest {
    double distance;     ///< [m] to the nearest piece; the limit when none is nearer
    double edge = 0;     ///< [m] length of that piece
    bool inside = true;  ///< on the cloth's side of it
  };
  Nearest nearest(const Vec2& p, double limit) const;
  /// How far from p along the unit vector `ray` the next piece is whose normal points back within the angle of that
  /// cosine; `limit` when there is none before.
  double across(const Vec2& p, const Vec2& ray, double limit, double cosine) const;

 private:
  struct Piece {
    Vec2 a, d;
    double inverse_square;  ///< 1 / |d|^2
    int segment;            ///< of the boundary
  };
  bool ends_segment(int i) const {
    return i + 1 == static_cast<int>(pieces_.size()) || pieces_[i + 1].segment != pieces_[i].segment;
  }

  const Boundary& boundary_;
  double longest_ = 0;
  std::vector<Piece> pieces_;
  CellGrid grid_;
};

}  // namespace vitrine::mesh_room
