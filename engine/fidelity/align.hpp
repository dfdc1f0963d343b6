// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "masks.hpp"
#include "vitrine/fidelity.hpp"

namespace vitrine::fidelity {

/// What may be fitted besides the shift.
enum class Freedom { shift, one_scale, two_scales };

/// Intersection over union of the worn silhouette and the photo's laid over it.
double overlap(const Mask& photo, const Mask& worn, const FlatToWorn& fit);

/// The fit of the best overlap near `start`, by a compass search: steps are halved from 2 cm and 4 % to 0.1 mm and
/// 0.02 %.
FlatToWorn align(const Mask& photo, const Mask& worn, FlatToWorn start, Freedom freedom, double& iou);

/// Box on box: where a search may start from.
FlatToWorn box_on_box(const Mask& photo, const Mask& worn);

}  // namespace vitrine::fidelity
