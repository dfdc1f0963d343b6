// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "vitrine/model/garment_template.hpp"

namespace vitrine {

/// A template as text for a terminal: features, edges, seams, poses, fabrics.
std::string describe(const GarmentTemplate& garment);
std::string describe(const NecklineTemplate& neckline);

/// A template as a drawing, every pose next to the other: outline with edges coloured by kind, feature points with
/// their search circles, seams, limbs, a legend. SVG 1.1 of plain shapes and text, no scripts, no links.
std::string draw_svg(const GarmentTemplate& garment);
/// The profile at its default depth, with its points.
std::string draw_svg(const NecklineTemplate& neckline);

}  // namespace vitrine
