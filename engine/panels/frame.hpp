// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <string>

#include "vitrine/features.hpp"
#include "vitrine/panels.hpp"

namespace vitrine::panels_room {

/// Feature positions in pixels after the photo's tilt is removed, y still down.
std::vector<Vec2> upright_pixels(const Features& features);

/// The contour likewise.
std::vector<Vec2> upright_contour(const Features& features);

/// Mean height of the anchors [px], the top of the points where there are none.
double anchor_height(const std::vector<Vec2>& upright, const GarmentTemplate& garment);

/// Distance of the scale rule's two features [px].
double scale_distance(const std::vector<Vec2>& upright, const ScaleRule& rule);

/// Vertical distance top to bottom of the scale rule [px], the mean of both sides where the features have partners.
double scale_height(const std::vector<Vec2>& upright, const GarmentTemplate& garment);

struct FrontScale {
  double metres_per_pixel = 0;
  std::string source;   ///< "chest", "length" or "ease"
  std::string warning;  ///< empty when the measurements agree
};

/// Metres per pixel of the front photo from the shop's measurements or the plugin's ease.
Result<FrontScale> front_scale(const std::vector<Vec2>& upright, const GarmentTemplate& garment,
                               const PanelOptions& options);

/// How much shorter [-] than in the photo's proportions a garment is made so that what hangs below its anchors fits
/// into `room` [m]: sizes are graded in width more than in length. 1 where the room is unknown or enough.
double shortened(const std::vector<Vec2>& contour, double anchor_y, double metres_per_pixel, double room);

/// Panel metres to photo pixels: tilt, scale, lengths times `shorter`, x = 0 at the mean of the mirror pairs, y = 0 at
/// the anchors' mean height.
Affine2 pixel_from_panel(const std::vector<Vec2>& upright, double tilt_deg, double metres_per_pixel, double shorter,
                         const GarmentTemplate& garment);

}  // namespace vitrine::panels_room
