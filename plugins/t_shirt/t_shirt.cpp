// SPDX-License-Identifier: MIT
// A T-shirt: the torso with two sleeves that end above the elbow.
#include "vitrine/check.hpp"
#include "vitrine/templates/sleeve.hpp"

namespace {

using namespace vitrine;
using namespace vitrine::templates;

constexpr auto features =
    sdk::join(torso_neck, torso_shoulder_right(VITRINE_TURN_ANY), short_sleeve_right, torso_body(VITRINE_TURN_CONCAVE),
              short_sleeve_left, torso_shoulder_left(VITRINE_TURN_ANY));

// Left halves, as they lie in flat-lay photos; the right half is the mirror image.
constexpr vitrine_pose_point sleeves_out_half[] = {
    {"neck_left", 0.365, 0.003, 0.08},       {"shoulder_left", 0.195, 0.078, 0.08},
    {"armpit_left", 0.165, 0.380, 0.12},     {"cuff_lower_left", 0.105, 0.400, 0.12},
    {"cuff_upper_left", 0.005, 0.230, 0.12}, {"hem_left", 0.160, 0.985, 0.12},
};
constexpr auto sleeves_out = sdk::symmetric_pose(features, sleeves_out_half);
constexpr vitrine_pose_point sleeves_down_half[] = {
    {"neck_left", 0.360, 0.003, 0.08},       {"shoulder_left", 0.150, 0.070, 0.08},
    {"armpit_left", 0.120, 0.360, 0.12},     {"cuff_lower_left", 0.080, 0.430, 0.12},
    {"cuff_upper_left", 0.005, 0.280, 0.12}, {"hem_left", 0.110, 0.985, 0.12},
};
constexpr auto sleeves_down = sdk::symmetric_pose(features, sleeves_down_half);
constexpr std::array<vitrine_pose, 2> poses = {{
    {"sleeves_out", sdk::span(sleeves_out)},
    {"sleeves_down", sdk::span(sleeves_down)},
}};

constexpr auto edges =
    sdk::join(torso_edges_top, sleeve_edges_right, torso_edges_body, sleeve_edges_left, torso_edges_last);
constexpr auto seams = sdk::join(torso_seams, sleeve_seams);
constexpr vitrine_scale_rule scale = torso_scale(1.12);
constexpr auto fabrics = std::array{jersey, rib_knit, cotton_woven, satin};

constexpr std::array<vitrine_garment, 1> garments = {{{.id = "t_shirt",
                                                       .title = "T-shirt",
                                                       .features = sdk::span(features),
                                                       .poses = sdk::span(poses),
                                                       .edges = sdk::span(edges),
                                                       .seams = sdk::span(seams),
                                                       .limbs = sdk::span(short_sleeve_limbs),
                                                       .scale = sdk::span_one(scale),
                                                       .anchors = sdk::span(torso_anchors),
                                                       .fabrics = sdk::span(fabrics)}}};
static_assert(sdk::check(garments[0]));

}  // namespace

VITRINE_PLUGIN(.vendor = "Vitrine", .id = "org.vitrine.t_shirt", .version = "0.1.0",
               .garments = vitrine::sdk::span(garments), .necklines = {}, .extension = nullptr);
