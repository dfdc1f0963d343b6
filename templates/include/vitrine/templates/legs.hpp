// SPDX-License-Identifier: MIT
#pragma once
// Two legs that hang from a waist and meet in a crotch: what every kind of trousers shares. The crotch is one feature
// on the middle line, root of both limbs; at it the four inside edges meet.
#include <array>

#include "vitrine/plugin.hpp"

namespace vitrine::templates {

/// Features clockwise in the picture; `hem_left` and `hem_right` are the body landmarks that the openings hang near.
consteval std::array<vitrine_feature, 7> legs_features(const char* hem_left, const char* hem_right) {
  return {{
      {"waist_left", "waist_left", "waist_right", VITRINE_TURN_CONVEX, 0},
      {"waist_right", "waist_right", "waist_left", VITRINE_TURN_CONVEX, 0},
      {"hem_outer_right", hem_right, "hem_outer_left", VITRINE_TURN_CONVEX, 0},
      {"hem_inner_right", hem_right, "hem_inner_left", VITRINE_TURN_CONVEX, 0},
      {"crotch", "crotch", "crotch", VITRINE_TURN_CONCAVE, 0},
      {"hem_inner_left", hem_left, "hem_inner_right", VITRINE_TURN_CONVEX, 0},
      {"hem_outer_left", hem_left, "hem_outer_right", VITRINE_TURN_CONVEX, 0},
  }};
}

inline constexpr std::array<vitrine_edge, 7> legs_edges = {{
    {"waist", "waist_left", "waist_right", VITRINE_EDGE_OPEN, 0},
    {"side_right", "waist_right", "hem_outer_right", VITRINE_EDGE_SEAM, 0},
    {"hem_right", "hem_outer_right", "hem_inner_right", VITRINE_EDGE_OPEN, 0},
    {"inside_leg_right", "hem_inner_right", "crotch", VITRINE_EDGE_SEAM, 0},
    {"inside_leg_left", "crotch", "hem_inner_left", VITRINE_EDGE_SEAM, 0},
    {"hem_left", "hem_inner_left", "hem_outer_left", VITRINE_EDGE_OPEN, 0},
    {"side_left", "hem_outer_left", "waist_left", VITRINE_EDGE_SEAM, 0},
}};
inline constexpr std::array<vitrine_seam, 4> legs_seams = {{
    {"side_right", "side_right", VITRINE_SIDE_FRONT, VITRINE_SIDE_BACK, 0, 0},
    {"inside_leg_right", "inside_leg_right", VITRINE_SIDE_FRONT, VITRINE_SIDE_BACK, 0, 0},
    {"inside_leg_left", "inside_leg_left", VITRINE_SIDE_FRONT, VITRINE_SIDE_BACK, 0, 0},
    {"side_left", "side_left", VITRINE_SIDE_FRONT, VITRINE_SIDE_BACK, 0, 0},
}};

/// A leg's tube: its root runs from the waist's corner to the crotch, its middle down the body's leg.
consteval std::array<vitrine_limb, 2> legs_limbs(const vitrine_name_span& left, const vitrine_name_span& right) {
  return {{{"leg_left", "waist_left", "crotch", "hem_outer_left", "hem_inner_left", left},
           {"leg_right", "waist_right", "crotch", "hem_outer_right", "hem_inner_right", right}}};
}

/// They hang from the waist or, where the rise is shorter than the body's, from the crotch.
inline constexpr std::array<vitrine_name, 3> legs_anchors = {{{"waist_left"}, {"waist_right"}, {"crotch"}}};

}  // namespace vitrine::templates
