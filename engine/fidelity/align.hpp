// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "masks.hpp"
#include "vitrine/fidelity.hpp"

namespace vitrine::fidelity {

/// What may be fitted besides the shift.
enum class Freedom { shift, one_scale, two_scales };

/// Two silhouettes, ready to be laid over each other in many ways: the worn one as runs of pixels, the photo's as sums
/// along its rows, so that a way costs a few thousand steps.
class Overlay {
 public:
  Overlay(const Mask& photo, const Mask& worn);
  /// Intersection over union of the worn silhouette and the photo's laid over it.
  double iou(const FlatToWorn& fit) const;
  /// The fit of the best overlap near `start`, by a compass search over the shift, the scales and, with two of them,
  /// the box's four sides: steps are halved from 2 cm and 4 % to 0.1 mm and 0.02 %.
  FlatToWorn align(FlatToWorn start, Freedom freedom, double& iou) const;

 private:
  struct Run {
    double y, from, to;  // [m]
  };
  double covered(int row, double column) const;

  std::vector<Run> runs_;
  std::vector<std::uint32_t> sums_;  // per row of the photo width + 1 numbers: pixels set before each column
  int width_ = 0, height_ = 0;
  double pixel_, worn_pixel_, photo_area_ = 0, worn_area_ = 0;
  Vec2 top_left_, low_, high_;
};

/// Box on box: where a search may start from.
FlatToWorn box_on_box(const Mask& photo, const Mask& worn);

}  // namespace vitrine::fidelity
