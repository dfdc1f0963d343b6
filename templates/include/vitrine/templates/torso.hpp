// SPDX-License-Identifier: MIT
#pragma once
// The body of a top, shared by every garment that hangs on the shoulders, and the sleeveless garment made of it alone.
#include <array>

#include "vitrine/plugin.hpp"
#include "vitrine/templates/fabrics.hpp"

namespace vitrine::templates {

// Features clockwise in the picture. A sleeve goes between a shoulder and its armpit.
inline constexpr std::array<vitrine_feature, 2> torso_neck = {{
    {"neck_left", "neck_left", "neck_right", VITRINE_TURN_CONVEX, 0},
    {"neck_right", "neck_right", "neck_left", VITRINE_TURN_CONVEX, 0},
}};
/// The outer end of the shoulder line. It is a corner where the garment ends there (vest) and any bend where a sleeve
/// goes on.
consteval std::array<vitrine_feature, 1> torso_shoulder_right(std::int32_t turn) {
  return {{{"shoulder_right", "shoulder_right", "shoulder_left", turn, 0}}};
}
/// Armhole and side seam meet in a corner that points outwards (vest); under a sleeve the outline turns inwards.
consteval std::array<vitrine_feature, 4> torso_body(std::int32_t armpit_turn) {
  return {{
      {"armpit_right", "armpit_right", "armpit_left", armpit_turn, 0},
      {"hem_right", "hip_right", "hem_left", VITRINE_TURN_CONVEX, 0},
      {"hem_left", "hip_left", "hem_right", VITRINE_TURN_CONVEX, 0},
      {"armpit_left", "armpit_left", "armpit_right", armpit_turn, 0},
  }};
}
consteval std::array<vitrine_feature, 1> torso_shoulder_left(std::int32_t turn) {
  return {{{"shoulder_left", "shoulder_left", "shoulder_right", turn, 0}}};
}

// Edges clockwise in the picture, the armholes or sleeves left out.
inline constexpr std::array<vitrine_edge, 2> torso_edges_top = {{
    {"neck", "neck_left", "neck_right", VITRINE_EDGE_NECK, 0},
    {"shoulder_seam_right", "neck_right", "shoulder_right", VITRINE_EDGE_SEAM, 0},
}};
inline constexpr std::array<vitrine_edge, 3> torso_edges_body = {{
    {"side_right", "armpit_right", "hem_right", VITRINE_EDGE_SEAM, 0},
    {"hem", "hem_right", "hem_left", VITRINE_EDGE_OPEN, 0},
    {"side_left", "hem_left", "armpit_left", VITRINE_EDGE_SEAM, 0},
}};
inline constexpr std::array<vitrine_edge, 1> torso_edges_last = {{
    {"shoulder_seam_left", "shoulder_left", "neck_left", VITRINE_EDGE_SEAM, 0},
}};

/// Front and back share one frame, so a seam joins the front and back edge of one name, in the same direction.
consteval vitrine_seam front_to_back(const char* edge) {
  return {edge, edge, VITRINE_SIDE_FRONT, VITRINE_SIDE_BACK, 0, 0};
}
inline constexpr std::array<vitrine_seam, 4> torso_seams = {front_to_back("shoulder_seam_right"),
                                                            front_to_back("side_right"), front_to_back("side_left"),
                                                            front_to_back("shoulder_seam_left")};

/// A top hangs from the sides of the neck.
inline constexpr std::array<vitrine_name, 2> torso_anchors = {{{"neck_left"}, {"neck_right"}}};

/// Bust girth over the armpits; length from the side of the neck to the hem, as shops list it.
consteval vitrine_scale_rule torso_scale(double ease) {
  return {"armpit_left", "armpit_right", "bust", ease, "neck_left", "hem_left"};
}

// --- The vest: the torso with its armholes left open.

inline constexpr auto vest_features =
    sdk::join(torso_neck, torso_shoulder_right(VITRINE_TURN_CONVEX), torso_body(VITRINE_TURN_CONVEX),
              torso_shoulder_left(VITRINE_TURN_CONVEX));

// Left halves, as means over flat-lay photos of vests; the right half is the mirror image.
inline constexpr vitrine_pose_point vest_wide_straps_half[] = {
    {"neck_left", 0.300, 0.005, 0.10},
    {"shoulder_left", 0.155, 0.030, 0.10},
    {"armpit_left", 0.030, 0.335, 0.12},
    {"hem_left", 0.010, 0.980, 0.12},
};
inline constexpr auto vest_wide_straps = sdk::symmetric_pose(vest_features, vest_wide_straps_half);
inline constexpr vitrine_pose_point vest_narrow_straps_half[] = {
    {"neck_left", 0.160, 0.020, 0.12},
    {"shoulder_left", 0.070, 0.040, 0.12},
    {"armpit_left", 0.020, 0.340, 0.14},
    {"hem_left", 0.025, 0.970, 0.14},
};
inline constexpr auto vest_narrow_straps = sdk::symmetric_pose(vest_features, vest_narrow_straps_half);
inline constexpr vitrine_pose_point vest_cropped_half[] = {
    {"neck_left", 0.320, 0.005, 0.10},
    {"shoulder_left", 0.160, 0.050, 0.10},
    {"armpit_left", 0.030, 0.520, 0.12},
    {"hem_left", 0.020, 0.975, 0.12},
};
inline constexpr auto vest_cropped = sdk::symmetric_pose(vest_features, vest_cropped_half);
inline constexpr std::array<vitrine_pose, 3> vest_poses = {{
    {"wide_straps", sdk::span(vest_wide_straps)},
    {"narrow_straps", sdk::span(vest_narrow_straps)},
    {"cropped", sdk::span(vest_cropped)},
}};

inline constexpr auto vest_edges =
    sdk::join(torso_edges_top,
              std::array<vitrine_edge, 1>{{{"armhole_right", "shoulder_right", "armpit_right", VITRINE_EDGE_OPEN, 0}}},
              torso_edges_body,
              std::array<vitrine_edge, 1>{{{"armhole_left", "armpit_left", "shoulder_left", VITRINE_EDGE_OPEN, 0}}},
              torso_edges_last);

inline constexpr vitrine_scale_rule vest_scale = torso_scale(1.06);

inline constexpr vitrine_garment vest = {.id = "vest",
                                         .title = "Vest",
                                         .features = sdk::span(vest_features),
                                         .poses = sdk::span(vest_poses),
                                         .edges = sdk::span(vest_edges),
                                         .seams = sdk::span(torso_seams),
                                         .limbs = {},
                                         .scale = sdk::span_one(vest_scale),
                                         .anchors = sdk::span(torso_anchors),
                                         .fabrics = sdk::span(vest_fabrics)};

}  // namespace vitrine::templates
