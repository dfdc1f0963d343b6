// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "vitrine/model/body.hpp"

namespace vitrine {

/// Where the sides of a garment can pass between trunk and arms, seen from the front.
class Gaps {
 public:
  /// Arms are found by the landmarks shoulder, elbow and wrist; a body without them has no gaps.
  Gaps(const Mannequin& mannequin, const DistanceField& field);

  /// Middle of the gap [m from x = 0] at height y; `side` -1 left, +1 right. Infinity where no arm hangs beside the
  /// trunk, or the two are one.
  double middle(double y, int side) const;
  /// The same, and above the armpit, where arm and trunk are one, the armpit's own: the way to the top of a side seam.
  double middle_or_armpit(double y, int side) const;

 private:
  double bottom_ = 0, cell_ = 0.012;
  std::vector<double> middle_[2];  // [m] per row
};

}  // namespace vitrine
