// SPDX-License-Identifier: MIT
#pragma once
// A skirt: two panels that hang from the waist.
#include <array>

#include "vitrine/plugin.hpp"
#include "vitrine/templates/fabrics.hpp"

namespace vitrine::templates {

inline constexpr std::array<vitrine_feature, 4> skirt_features = {{
    {"waist_left", "waist_left", "waist_right", VITRINE_TURN_CONVEX, 0},
    {"waist_right", "waist_right", "waist_left", VITRINE_TURN_CONVEX, 0},
    {"hem_right", "knee_right", "hem_left", VITRINE_TURN_CONVEX, 0},
    {"hem_left", "knee_left", "hem_right", VITRINE_TURN_CONVEX, 0},
}};

// Left halves, as means over flat-lay photos; the right half is the mirror image.
inline constexpr vitrine_pose_point skirt_straight_half[] = {
    {"waist_left", 0.140, 0.020, 0.12},
    {"hem_left", 0.010, 0.950, 0.12},
};
inline constexpr auto skirt_straight = sdk::symmetric_pose(skirt_features, skirt_straight_half);
inline constexpr vitrine_pose_point skirt_flared_half[] = {
    {"waist_left", 0.330, 0.010, 0.12},
    {"hem_left", 0.003, 0.850, 0.14},
};
inline constexpr auto skirt_flared = sdk::symmetric_pose(skirt_features, skirt_flared_half);
inline constexpr vitrine_pose_point skirt_pencil_half[] = {
    {"waist_left", 0.015, 0.025, 0.10},
    {"hem_left", 0.060, 0.975, 0.12},
};
inline constexpr auto skirt_pencil = sdk::symmetric_pose(skirt_features, skirt_pencil_half);
inline constexpr std::array<vitrine_pose, 3> skirt_poses = {{
    {"straight", sdk::span(skirt_straight)},
    {"flared", sdk::span(skirt_flared)},
    {"pencil", sdk::span(skirt_pencil)},
}};

inline constexpr std::array<vitrine_edge, 4> skirt_edges = {{
    {"waist", "waist_left", "waist_right", VITRINE_EDGE_OPEN, 0},
    {"side_right", "waist_right", "hem_right", VITRINE_EDGE_SEAM, 0},
    {"hem", "hem_right", "hem_left", VITRINE_EDGE_OPEN, 0},
    {"side_left", "hem_left", "waist_left", VITRINE_EDGE_SEAM, 0},
}};
inline constexpr std::array<vitrine_seam, 2> skirt_seams = {{
    {"side_right", "side_right", VITRINE_SIDE_FRONT, VITRINE_SIDE_BACK, 0, 0},
    {"side_left", "side_left", VITRINE_SIDE_FRONT, VITRINE_SIDE_BACK, 0, 0},
}};
inline constexpr vitrine_scale_rule skirt_scale = {"waist_left", "waist_right", "waist", 1.0, "waist_left", "hem_left"};
inline constexpr std::array<vitrine_name, 2> skirt_anchors = {{{"waist_left"}, {"waist_right"}}};

inline constexpr vitrine_garment skirt = {.id = "skirt",
                                          .title = "Skirt",
                                          .features = sdk::span(skirt_features),
                                          .poses = sdk::span(skirt_poses),
                                          .edges = sdk::span(skirt_edges),
                                          .seams = sdk::span(skirt_seams),
                                          .limbs = {},
                                          .scale = sdk::span_one(skirt_scale),
                                          .anchors = sdk::span(skirt_anchors),
                                          .fabrics = sdk::span(skirt_fabrics)};

}  // namespace vitrine::templates
