// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "vitrine/model/geometry.hpp"

namespace vitrine::panels_room {

/// A place on a curve that becomes a node as it is.
struct Stop {
  double arc = 0;  ///< [m] from the curve's start
  Vec2 position = Vec2::Zero();
};

/// A polyline in metres that can be asked by arc length; its first and last point are exact.
class Curve {
 public:
  /// Low-passes the points over an arc of `window` [m] on both sides; the stair steps of a pixel contour would
  /// otherwise make a slanted edge up to 41 % too long.
  Curve(const std::vector<Vec2>& points, double window);

  double length() const { return arc_.back(); }
  Vec2 at(double arc) const;
  /// Mean position over [arc - half, arc + half], the half shortened at the ends so that straight lines stay put.
  Vec2 mean(double arc, double half) const;
  /// Sharp corners inside the curve (the tip of a V-neck), at least `spacing` from each other and from the ends.
  std::vector<Stop> sharp_corners(double spacing) const;

 private:
  void measure();
  std::size_t piece(double arc) const;
  Vec2 integral(double arc) const;

  std::vector<Vec2> raw_, points_;
  std::vector<double> arc_;
  std::vector<Vec2> sum_;  ///< integral of the position over the arc up to each point
};

/// The nodes of a curve after its first and before its last point: `segments` of equal arc, each node averaged over
/// the arc it stands for. Between stops (kept exactly) the segments are shared out by length; `segments` must exceed
/// the number of stops.
std::vector<Vec2> inner_nodes(const Curve& curve, int segments, const std::vector<Stop>& stops);

}  // namespace vitrine::panels_room
