// SPDX-License-Identifier: MIT
#pragma once
// The three necklines of the paper (III.A), each a curve over the neck edge: s along the edge, depth towards the hem.
//
// The ratio ranges follow from the curves. In the box under the neck edge a V leaves as much foreground as background
// (ratio 1), a square neck none (0), a half ellipse (1 - pi/4) / (pi/4) = 0.27. The limits lie between; sewn square
// necks have round corners and leaning sides, which bring them to 0.1 to 0.25.
#include <array>

#include "vitrine/plugin.hpp"

namespace vitrine::templates {

/// Half an ellipse, at equal angles: s = (1 - cos a) / 2, depth = sin a for a = 0, 15, ... 180 degrees.
inline constexpr std::array<vitrine_profile_point, 13> u_profile = {{{0.0, 0.0},
                                                                     {0.01703709, 0.25881905},
                                                                     {0.06698730, 0.5},
                                                                     {0.14644661, 0.70710678},
                                                                     {0.25, 0.86602540},
                                                                     {0.37059048, 0.96592583},
                                                                     {0.5, 1.0},
                                                                     {0.62940952, 0.96592583},
                                                                     {0.75, 0.86602540},
                                                                     {0.85355339, 0.70710678},
                                                                     {0.93301270, 0.5},
                                                                     {0.98296291, 0.25881905},
                                                                     {1.0, 0.0}}};
inline constexpr std::array<vitrine_profile_point, 3> v_profile = {{{0.0, 0.0}, {0.5, 1.0}, {1.0, 0.0}}};
inline constexpr std::array<vitrine_profile_point, 4> square_profile = {
    {{0.0, 0.0}, {0.04, 1.0}, {0.96, 1.0}, {1.0, 0.0}}};

inline constexpr vitrine_neckline neck_u = {"neck_u", "U-neck", sdk::span(u_profile), 0.18, 0.50, 0.60};
inline constexpr vitrine_neckline neck_v = {"neck_v", "V-neck", sdk::span(v_profile), 0.50, 100.0, 0.75};
inline constexpr vitrine_neckline neck_square = {"neck_square", "Square neck", sdk::span(square_profile),
                                                 0.0,           0.18,          0.50};

}  // namespace vitrine::templates
