// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "vitrine/model/geometry.hpp"

namespace vitrine::mesh_room {

using Loop = std::vector<Vec2>;

/// Signed area of a closed polygon [m^2], positive counter-clockwise.
double polygon_area(std::span<const Vec2> loop);

/// The outline and the holes as one list of nodes: outline first, then each hole, all in the order given.
class Boundary {
 public:
  Boundary(std::span<const Vec2> outline, std::span<const Loop> holes);
  std::size_t size() const { return nodes_.size(); }
  const std::vector<Vec2>& nodes() const { return nodes_; }
  const Vec2& operator[](std::size_t i) const { return nodes_[i]; }
  std::size_t next(std::size_t i) const { return next_[i]; }
  std::size_t previous(std::size_t i) const { return previous_[i]; }
  std::size_t loop_count() const { return start_.size() - 1; }
  /// Nodes [loop_start(l), loop_start(l + 1)) are loop l; 0 is the outline.
  std::size_t loop_start(std::size_t l) const { return start_[l]; }
  /// Unit normal of the segment from node i, towards the cloth, whatever way round the loops are given.
  const Vec2& inward(std::size_t i) const { return inward_[i]; }
  double segment(std::size_t i) const { return length_[i]; }
  double area() const { return area_; }  ///< [m^2] of the cloth, holes taken out
  const Vec2& low() const { return low_; }
  const Vec2& high() const { return high_; }

 private:
  std::vector<Vec2> nodes_, inward_;
  std::vector<double> length_;
  std::vector<std::size_t> next_, previous_, start_;
  Vec2 low_, high_;
  double area_ = 0;
};

}  // namespace vitrine::mesh_room
