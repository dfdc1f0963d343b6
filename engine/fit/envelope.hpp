// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "vitrine/model/body.hpp"

namespace vitrine {

/// How far the body reaches to the front (or, with direction -1, to the back) over the x/y plane: a smooth sheet that
/// clears every voxel of the body within `reach` of each point.
class Envelope {
 public:
  /// direction +1 front, -1 back; cell and reach [m].
  Envelope(const DistanceField& field, int direction, double cell = 0.012, double reach = 0.07);

  /// z [m] of the sheet at (x, y); off the body it runs on at the height of the nearest part.
  double operator()(double x, double y) const;

 private:
  double at(int ix, int iy) const;
  Vec2 origin_;
  double cell_;
  int columns_ = 0, rows_ = 0;
  std::vector<double> height_;  // [m], x fastest
};

}  // namespace vitrine
