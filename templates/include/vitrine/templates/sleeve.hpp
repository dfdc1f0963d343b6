// SPDX-License-Identifier: MIT
#pragma once
// Sleeves between shoulder and armpit, long and short, and the long-sleeved top: the torso with two long ones.
#include <array>

#include "vitrine/plugin.hpp"
#include "vitrine/templates/torso.hpp"

namespace vitrine::templates {

/// The cuff's corners; `landmark`: where on the arm a cuff of this kind ends.
consteval std::array<vitrine_feature, 2> sleeve_to_right(const char* landmark) {
  return {{
      {"cuff_upper_right", landmark, "cuff_upper_left", VITRINE_TURN_CONVEX, 0},
      {"cuff_lower_right", landmark, "cuff_lower_left", VITRINE_TURN_CONVEX, 0},
  }};
}
consteval std::array<vitrine_feature, 2> sleeve_to_left(const char* landmark) {
  return {{
      {"cuff_lower_left", landmark, "cuff_lower_right", VITRINE_TURN_CONVEX, 0},
      {"cuff_upper_left", landmark, "cuff_upper_right", VITRINE_TURN_CONVEX, 0},
  }};
}
inline constexpr auto sleeve_right = sleeve_to_right("wrist_right");
inline constexpr auto sleeve_left = sleeve_to_left("wrist_left");
inline constexpr auto short_sleeve_right = sleeve_to_right("elbow_right");
inline constexpr auto short_sleeve_left = sleeve_to_left("elbow_left");
inline constexpr std::array<vitrine_edge, 3> sleeve_edges_right = {{
    {"sleeve_upper_right", "shoulder_right", "cuff_upper_right", VITRINE_EDGE_SEAM, 0},
    {"cuff_right", "cuff_upper_right", "cuff_lower_right", VITRINE_EDGE_OPEN, 0},
    {"sleeve_under_right", "cuff_lower_right", "armpit_right", VITRINE_EDGE_SEAM, 0},
}};
inline constexpr std::array<vitrine_edge, 3> sleeve_edges_left = {{
    {"sleeve_under_left", "armpit_left", "cuff_lower_left", VITRINE_EDGE_SEAM, 0},
    {"cuff_left", "cuff_lower_left", "cuff_upper_left", VITRINE_EDGE_OPEN, 0},
    {"sleeve_upper_left", "cuff_upper_left", "shoulder_left", VITRINE_EDGE_SEAM, 0},
}};
inline constexpr std::array<vitrine_seam, 4> sleeve_seams = {
    front_to_back("sleeve_upper_right"), front_to_back("sleeve_under_right"), front_to_back("sleeve_under_left"),
    front_to_back("sleeve_upper_left")};

inline constexpr std::array<vitrine_name, 3> arm_left = {{{"shoulder_left"}, {"elbow_left"}, {"wrist_left"}}};
inline constexpr std::array<vitrine_name, 3> arm_right = {{{"shoulder_right"}, {"elbow_right"}, {"wrist_right"}}};
inline constexpr std::array<vitrine_limb, 2> sleeve_limbs = {{
    {"sleeve_left", "shoulder_left", "armpit_left", "cuff_upper_left", "cuff_lower_left", sdk::span(arm_left)},
    {"sleeve_right", "shoulder_right", "armpit_right", "cuff_upper_right", "cuff_lower_right", sdk::span(arm_right)},
}};
inline constexpr std::array<vitrine_name, 2> upper_arm_left = {{{"shoulder_left"}, {"elbow_left"}}};
inline constexpr std::array<vitrine_name, 2> upper_arm_right = {{{"shoulder_right"}, {"elbow_right"}}};
/// A sleeve that ends above the elbow follows the upper arm alone.
inline constexpr std::array<vitrine_limb, 2> short_sleeve_limbs = {{
    {"sleeve_left", "shoulder_left", "armpit_left", "cuff_upper_left", "cuff_lower_left", sdk::span(upper_arm_left)},
    {"sleeve_right", "shoulder_right", "armpit_right", "cuff_upper_right", "cuff_lower_right",
     sdk::span(upper_arm_right)},
}};

// --- The long-sleeved top.

inline constexpr auto long_sleeve_features =
    sdk::join(torso_neck, torso_shoulder_right(VITRINE_TURN_ANY), sleeve_right, torso_body(VITRINE_TURN_CONCAVE),
              sleeve_left, torso_shoulder_left(VITRINE_TURN_ANY));

// Left halves, as means over flat-lay photos; the right half is the mirror image.
inline constexpr vitrine_pose_point sleeves_down_half[] = {
    {"neck_left", 0.405, 0.005, 0.08},       {"shoulder_left", 0.225, 0.070, 0.08},
    {"armpit_left", 0.195, 0.400, 0.12},     {"cuff_lower_left", 0.250, 0.895, 0.12},
    {"cuff_upper_left", 0.125, 0.925, 0.12}, {"hem_left", 0.200, 0.985, 0.12},
};
inline constexpr auto sleeves_down = sdk::symmetric_pose(long_sleeve_features, sleeves_down_half);
inline constexpr vitrine_pose_point sleeves_spread_half[] = {
    {"neck_left", 0.380, 0.010, 0.08},       {"shoulder_left", 0.250, 0.075, 0.08},
    {"armpit_left", 0.210, 0.355, 0.12},     {"cuff_lower_left", 0.140, 0.885, 0.16},
    {"cuff_upper_left", 0.040, 0.900, 0.16}, {"hem_left", 0.215, 0.970, 0.12},
};
inline constexpr auto sleeves_spread = sdk::symmetric_pose(long_sleeve_features, sleeves_spread_half);
inline constexpr vitrine_pose_point sleeves_wide_half[] = {
    {"neck_left", 0.430, 0.010, 0.08},       {"shoulder_left", 0.345, 0.080, 0.08},
    {"armpit_left", 0.330, 0.380, 0.14},     {"cuff_lower_left", 0.045, 0.640, 0.16},
    {"cuff_upper_left", 0.005, 0.520, 0.16}, {"hem_left", 0.330, 0.980, 0.14},
};
inline constexpr auto sleeves_wide = sdk::symmetric_pose(long_sleeve_features, sleeves_wide_half);
inline constexpr vitrine_pose_point sleeves_hanging_half[] = {
    {"neck_left", 0.260, 0.005, 0.10},       {"shoulder_left", 0.100, 0.070, 0.08},
    {"armpit_left", 0.150, 0.440, 0.14},     {"cuff_lower_left", 0.135, 0.975, 0.14},
    {"cuff_upper_left", 0.020, 0.950, 0.14}, {"hem_left", 0.215, 0.760, 0.14},
};
inline constexpr auto sleeves_hanging = sdk::symmetric_pose(long_sleeve_features, sleeves_hanging_half);
inline constexpr std::array<vitrine_pose, 4> long_sleeve_poses = {{
    {"sleeves_down", sdk::span(sleeves_down)},
    {"sleeves_spread", sdk::span(sleeves_spread)},
    {"sleeves_wide", sdk::span(sleeves_wide)},
    {"sleeves_hanging", sdk::span(sleeves_hanging)},
}};

inline constexpr auto long_sleeve_edges =
    sdk::join(torso_edges_top, sleeve_edges_right, torso_edges_body, sleeve_edges_left, torso_edges_last);
inline constexpr auto long_sleeve_seams = sdk::join(torso_seams, sleeve_seams);
inline constexpr vitrine_scale_rule long_sleeve_scale = torso_scale(1.12);

inline constexpr vitrine_garment long_sleeve = {.id = "long_sleeve",
                                                .title = "Long-sleeved top",
                                                .features = sdk::span(long_sleeve_features),
                                                .poses = sdk::span(long_sleeve_poses),
                                                .edges = sdk::span(long_sleeve_edges),
                                                .seams = sdk::span(long_sleeve_seams),
                                                .limbs = sdk::span(sleeve_limbs),
                                                .scale = sdk::span_one(long_sleeve_scale),
                                                .anchors = sdk::span(torso_anchors),
                                                .fabrics = sdk::span(long_sleeve_fabrics)};

}  // namespace vitrine::templates
