// SPDX-License-Identifier: MIT
// Dresses hang from the shoulders and reach to the knee: the torso, lengthened, with a waist in its sides; without
// sleeves, with short ones or with long ones.
#include "vitrine/check.hpp"
#include "vitrine/templates/sleeve.hpp"

namespace {

using namespace vitrine;
using namespace vitrine::templates;

/// Below the armpit. A waist need not be seen: a shift or a pinafore falls straight.
consteval std::array<vitrine_feature, 6> body(std::int32_t armpit_turn) {
  return {{
      {"armpit_right", "armpit_right", "armpit_left", armpit_turn, 0},
      {"waist_right", "waist_right", "waist_left", VITRINE_TURN_ANY, 0},
      {"hem_right", "knee_right", "hem_left", VITRINE_TURN_CONVEX, 0},
      {"hem_left", "knee_left", "hem_right", VITRINE_TURN_CONVEX, 0},
      {"waist_left", "waist_left", "waist_right", VITRINE_TURN_ANY, 0},
      {"armpit_left", "armpit_left", "armpit_right", armpit_turn, 0},
  }};
}
constexpr std::array<vitrine_edge, 5> body_edges = {{
    {"side_right", "armpit_right", "waist_right", VITRINE_EDGE_SEAM, 0},
    {"skirt_right", "waist_right", "hem_right", VITRINE_EDGE_SEAM, 0},
    {"hem", "hem_right", "hem_left", VITRINE_EDGE_OPEN, 0},
    {"skirt_left", "hem_left", "waist_left", VITRINE_EDGE_SEAM, 0},
    {"side_left", "waist_left", "armpit_left", VITRINE_EDGE_SEAM, 0},
}};
constexpr std::array<vitrine_seam, 2> skirt_seams = {front_to_back("skirt_right"), front_to_back("skirt_left")};

// --- Without sleeves. Left halves, as they lie in flat-lay photos; the right half is the mirror image.

constexpr auto features = sdk::join(torso_neck, torso_shoulder_right(VITRINE_TURN_CONVEX), body(VITRINE_TURN_ANY),
                                    torso_shoulder_left(VITRINE_TURN_CONVEX));
constexpr vitrine_pose_point sheath_half[] = {
    {"neck_left", 0.250, 0.002, 0.10},  {"shoulder_left", 0.130, 0.025, 0.10}, {"armpit_left", 0.130, 0.210, 0.10},
    {"waist_left", 0.150, 0.370, 0.10}, {"hem_left", 0.005, 0.985, 0.10},
};
constexpr auto sheath = sdk::symmetric_pose(features, sheath_half);
constexpr vitrine_pose_point pinafore_half[] = {
    {"neck_left", 0.290, 0.004, 0.10},  {"shoulder_left", 0.230, 0.015, 0.10}, {"armpit_left", 0.210, 0.185, 0.10},
    {"waist_left", 0.150, 0.380, 0.10}, {"hem_left", 0.005, 0.970, 0.10},
};
constexpr auto pinafore = sdk::symmetric_pose(features, pinafore_half);
constexpr vitrine_pose_point flared_half[] = {
    {"neck_left", 0.360, 0.004, 0.10},  {"shoulder_left", 0.280, 0.020, 0.10}, {"armpit_left", 0.230, 0.220, 0.10},
    {"waist_left", 0.260, 0.400, 0.10}, {"hem_left", 0.005, 0.960, 0.12},
};
constexpr auto flared = sdk::symmetric_pose(features, flared_half);
constexpr std::array<vitrine_pose, 3> poses = {
    {{"sheath", sdk::span(sheath)}, {"pinafore", sdk::span(pinafore)}, {"flared", sdk::span(flared)}}};
constexpr auto edges = sdk::join(
    torso_edges_top,
    std::array<vitrine_edge, 1>{{{"armhole_right", "shoulder_right", "armpit_right", VITRINE_EDGE_OPEN, 0}}},
    body_edges, std::array<vitrine_edge, 1>{{{"armhole_left", "armpit_left", "shoulder_left", VITRINE_EDGE_OPEN, 0}}},
    torso_edges_last);
constexpr auto seams = sdk::join(torso_seams, skirt_seams);

// --- With sleeves.

consteval auto with_sleeves(const std::array<vitrine_feature, 2>& right, const std::array<vitrine_feature, 2>& left) {
  return sdk::join(torso_neck, torso_shoulder_right(VITRINE_TURN_ANY), right, body(VITRINE_TURN_CONCAVE), left,
                   torso_shoulder_left(VITRINE_TURN_ANY));
}
constexpr auto long_features = with_sleeves(sleeve_right, sleeve_left);
constexpr auto short_features = with_sleeves(short_sleeve_right, short_sleeve_left);

constexpr vitrine_pose_point long_spread_half[] = {
    {"neck_left", 0.375, 0.010, 0.08},       {"shoulder_left", 0.270, 0.065, 0.08},
    {"armpit_left", 0.270, 0.285, 0.12},     {"waist_left", 0.255, 0.480, 0.12},
    {"cuff_lower_left", 0.075, 0.560, 0.16}, {"cuff_upper_left", 0.003, 0.480, 0.16},
    {"hem_left", 0.195, 0.980, 0.12},
};
constexpr auto long_spread = sdk::symmetric_pose(long_features, long_spread_half);
constexpr vitrine_pose_point long_beside_half[] = {
    {"neck_left", 0.390, 0.006, 0.08},       {"shoulder_left", 0.260, 0.045, 0.08},
    {"armpit_left", 0.250, 0.240, 0.12},     {"waist_left", 0.270, 0.400, 0.12},
    {"cuff_lower_left", 0.090, 0.560, 0.16}, {"cuff_upper_left", 0.005, 0.540, 0.16},
    {"hem_left", 0.150, 0.980, 0.14},
};
constexpr auto long_beside = sdk::symmetric_pose(long_features, long_beside_half);
constexpr std::array<vitrine_pose, 2> long_poses = {
    {{"sleeves_spread", sdk::span(long_spread)}, {"sleeves_beside", sdk::span(long_beside)}}};

constexpr vitrine_pose_point short_out_half[] = {
    {"neck_left", 0.370, 0.004, 0.08},       {"shoulder_left", 0.210, 0.045, 0.08},
    {"armpit_left", 0.190, 0.240, 0.12},     {"waist_left", 0.210, 0.400, 0.12},
    {"cuff_lower_left", 0.090, 0.270, 0.12}, {"cuff_upper_left", 0.010, 0.160, 0.12},
    {"hem_left", 0.090, 0.985, 0.14},
};
constexpr auto short_out = sdk::symmetric_pose(short_features, short_out_half);
constexpr std::array<vitrine_pose, 1> short_poses = {{{"sleeves_out", sdk::span(short_out)}}};

constexpr auto sleeved_edges =
    sdk::join(torso_edges_top, sleeve_edges_right, body_edges, sleeve_edges_left, torso_edges_last);
constexpr auto sleeved_seams = sdk::join(torso_seams, skirt_seams, sleeve_seams);

// Sleeveless dresses are cut close. And who photographs a long garment on the floor stands at its hem: its bust,
// further from the camera, looks a tenth too small beside its length. Waist and hips make it larger where they need it.
constexpr vitrine_scale_rule scale = torso_scale(0.92), sleeved_scale = torso_scale(1.12);
constexpr auto fabrics = std::array{cotton_woven, jersey, rib_knit, satin, wool_twill, denim};

constexpr vitrine_garment sleeveless = {.id = "dress",
                                        .title = "Sleeveless dress",
                                        .features = sdk::span(features),
                                        .poses = sdk::span(poses),
                                        .edges = sdk::span(edges),
                                        .seams = sdk::span(seams),
                                        .limbs = {},
                                        .scale = sdk::span_one(scale),
                                        .anchors = sdk::span(torso_anchors),
                                        .fabrics = sdk::span(fabrics)};
consteval vitrine_garment sleeved(const char* id, const char* title, vitrine_feature_span all, vitrine_pose_span laid,
                                  vitrine_limb_span sleeves) {
  vitrine_garment g = sleeveless;
  g.id = id;
  g.title = title;
  g.features = all;
  g.poses = laid;
  g.edges = sdk::span(sleeved_edges);
  g.seams = sdk::span(sleeved_seams);
  g.limbs = sleeves;
  g.scale = sdk::span_one(sleeved_scale);
  return g;
}
constexpr std::array<vitrine_garment, 3> garments = {
    sleeveless,
    sleeved("dress_short_sleeve", "Dress with short sleeves", sdk::span(short_features), sdk::span(short_poses),
            sdk::span(short_sleeve_limbs)),
    sleeved("dress_long_sleeve", "Dress with long sleeves", sdk::span(long_features), sdk::span(long_poses),
            sdk::span(sleeve_limbs))};
static_assert(sdk::check(garments[0]) && sdk::check(garments[1]) && sdk::check(garments[2]));

}  // namespace

VITRINE_PLUGIN(.vendor = "Vitrine", .id = "org.vitrine.dress", .version = "0.1.0",
               .garments = vitrine::sdk::span(garments), .necklines = {}, .extension = nullptr);
