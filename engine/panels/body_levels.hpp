// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "vitrine/panels.hpp"

namespace vitrine::panels_room {

/// The least scale, from `metres_per_pixel` upwards, at which the flat garment is half as wide as the body is round at
/// every level it reaches. Flat width alone says nothing of hips: a straight skirt scaled by its waist would be too
/// tight to pass them. `outline` is the upright contour [px, y down], `anchor_y` the height of the anchors in it.
double scale_for_body(double metres_per_pixel, const std::vector<Vec2>& outline, double anchor_y,
                      const std::vector<BodyLevel>& levels);

}  // namespace vitrine::panels_room
