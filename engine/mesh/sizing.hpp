// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "boundary.hpp"
#include "cell_grid.hpp"
#include "wall.hpp"

namespace vitrine::mesh_room {

/// The target edge length at each place: the caller's, but finer where a part is narrower than four edges, down to a
/// quarter of its width, and around boundary segments that are themselves much shorter than the target. Never finer
/// than half the target in a narrow part: nodes nearer than that to a wall segment of the target's length would make
/// flat triangles.
class Sizing {
 public:
  Sizing(const Boundary& boundary, const Wall& wall, double edge_length);
  double target() const { return target_; }
  /// Whether the target holds everywhere.
  bool uniform() const { return spots_.empty(); }
  double at(const Vec2& p) const;

  /// A disc of finer edges; around it they grow back to the target.
  struct Spot {
    Vec2 centre;
    double radius, size;  ///< [m]
  };
  const std::vector<Spot>& spots() const { return spots_; }
  /// How far from the spot's centre edges of at most `size` are asked for [m].
  static double radius(const Spot& spot, double size);

 private:
  void add_narrow_parts(const Boundary& boundary, const Wall& wall);
  void add_short_segments(const Boundary& boundary);

  double target_, reach_ = 0;
  std::vector<Spot> spots_;
  CellGrid grid_;
};

}  // namespace vitrine::mesh_room
