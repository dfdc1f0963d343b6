/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A plugin as somebody built it in the days of ABI 1.0: every table, every field, with the header of then. */
#include <stddef.h>

#include "abi_1_0.h"

#define SPAN(table) \
  { table, sizeof table / sizeof table[0], sizeof table[0] }

static const vitrine_feature features[] = {
    {"shoulder_left", "shoulder_left", "shoulder_right", VITRINE_TURN_CONVEX, 0},
    {"neck_left", "neck_left", "neck_right", VITRINE_TURN_CONVEX, 0},
    {"neck_right", "neck_right", "neck_left", VITRINE_TURN_CONVEX, 0},
    {"shoulder_right", "shoulder_right", "shoulder_left", VITRINE_TURN_CONVEX, 0},
    {"cuff_upper_right", "wrist_right", "cuff_upper_left", VITRINE_TURN_CONVEX, 0},
    {"cuff_lower_right", NULL, "cuff_lower_left", VITRINE_TURN_ANY, 0},
    {"armpit_right", "armpit_right", "armpit_left", VITRINE_TURN_CONCAVE, 0},
    {"hem_right", "hip_right", "hem_left", VITRINE_TURN_CONVEX, 0},
    {"hem_left", "hip_left", "hem_right", VITRINE_TURN_CONVEX, 0},
    {"armpit_left", "armpit_left", "armpit_right", VITRINE_TURN_CONCAVE, 0},
    {"cuff_lower_left", NULL, "cuff_lower_right", VITRINE_TURN_ANY, 0},
    {"cuff_upper_left", "wrist_left", "cuff_upper_right", VITRINE_TURN_CONVEX, 0},
};
static const vitrine_pose_point spread[] = {
    {"shoulder_left", 0.30, 0.05, 0.10},  {"neck_left", 0.42, 0.00, 0.11},      {"neck_right", 0.58, 0.00, 0.11},
    {"shoulder_right", 0.70, 0.05, 0.10}, {"cuff_upper_right", 1.0, 0.40, 0.2}, {"cuff_lower_right", 0.95, 0.5, 0.2},
    {"armpit_right", 0.70, 0.35, 0.125},  {"hem_right", 0.70, 1.00, 0.15},      {"hem_left", 0.30, 1.00, 0.15},
    {"armpit_left", 0.30, 0.35, 0.125},   {"cuff_lower_left", 0.05, 0.5, 0.2},  {"cuff_upper_left", 0.0, 0.40, 0.2},
};
static const vitrine_pose poses[] = {{"spread", SPAN(spread)}};
static const vitrine_edge edges[] = {
    {"shoulder_seam_left", "shoulder_left", "neck_left", VITRINE_EDGE_SEAM, 0},
    {"neck", "neck_left", "neck_right", VITRINE_EDGE_NECK, 0},
    {"shoulder_seam_right", "neck_right", "shoulder_right", VITRINE_EDGE_SEAM, 0},
    {"sleeve_upper_right", "shoulder_right", "cuff_upper_right", VITRINE_EDGE_SEAM, 0},
    {"cuff_right", "cuff_upper_right", "cuff_lower_right", VITRINE_EDGE_OPEN, 0},
    {"sleeve_lower_right", "cuff_lower_right", "armpit_right", VITRINE_EDGE_SEAM, 0},
    {"side_right", "armpit_right", "hem_right", VITRINE_EDGE_SEAM, 0},
    {"hem", "hem_right", "hem_left", VITRINE_EDGE_OPEN, 0},
    {"side_left", "hem_left", "armpit_left", VITRINE_EDGE_SEAM, 0},
    {"sleeve_lower_left", "armpit_left", "cuff_lower_left", VITRINE_EDGE_SEAM, 0},
    {"cuff_left", "cuff_lower_left", "cuff_upper_left", VITRINE_EDGE_OPEN, 0},
    {"sleeve_upper_left", "cuff_upper_left", "shoulder_left", VITRINE_EDGE_SEAM, 0},
};
#define FRONT_TO_BACK(edge) \
  { edge, edge, VITRINE_SIDE_FRONT, VITRINE_SIDE_BACK, 0, 0 }
static const vitrine_seam seams[] = {
    FRONT_TO_BACK("shoulder_seam_left"), FRONT_TO_BACK("shoulder_seam_right"), FRONT_TO_BACK("sleeve_upper_right"),
    FRONT_TO_BACK("sleeve_lower_right"), FRONT_TO_BACK("side_right"),          FRONT_TO_BACK("side_left"),
    FRONT_TO_BACK("sleeve_lower_left"),  FRONT_TO_BACK("sleeve_upper_left"),
};
static const vitrine_name arm_left[] = {{"shoulder_left"}, {"elbow_left"}, {"wrist_left"}};
static const vitrine_name arm_right[] = {{"shoulder_right"}, {"elbow_right"}, {"wrist_right"}};
static const vitrine_limb limbs[] = {
    {"sleeve_left", "shoulder_left", "armpit_left", "cuff_upper_left", "cuff_lower_left", SPAN(arm_left)},
    {"sleeve_right", "shoulder_right", "armpit_right", "cuff_upper_right", "cuff_lower_right", SPAN(arm_right)},
};
static const vitrine_scale_rule scale[] = {{"armpit_left", "armpit_right", "bust", 1.25, "neck_left", "hem_left"}};
static const vitrine_name anchors[] = {{"neck_left"}, {"neck_right"}};
static const vitrine_fabric fabrics[] = {{"felt", 900, 180, 3.0e-5, 0.25, 0.5},
                                         {"silk", 800, 110, 6.0e-6, 0.125, 0.25}};
static const vitrine_garment garments[] = {{
    .id = "jumper_1_0",
    .title = "Jumper of 1.0",
    .features = SPAN(features),
    .poses = SPAN(poses),
    .edges = SPAN(edges),
    .seams = SPAN(seams),
    .limbs = SPAN(limbs),
    .scale = SPAN(scale),
    .anchors = SPAN(anchors),
    .fabrics = SPAN(fabrics),
}};

static const vitrine_profile_point profile[] = {{0.0, 0.0}, {0.25, 0.5}, {0.5, 1.0}, {1.0, 0.0}};
static const vitrine_neckline necklines[] = {{"neck_1_0", "Neck of 1.0", SPAN(profile), 0.5, 2.0, 0.75}};

const vitrine_plugin vitrine_plugin_entry = {
    VITRINE_HEADER,     .vendor = "Example",        .id = "org.example.built-with-1-0",
    .version = "1.2.3", .garments = SPAN(garments), .necklines = SPAN(necklines),
};
