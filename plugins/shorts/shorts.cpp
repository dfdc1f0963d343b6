// SPDX-License-Identifier: MIT
// Short trousers, down to the knee.
#include "vitrine/check.hpp"
#include "vitrine/templates/fabrics.hpp"
#include "vitrine/templates/legs.hpp"

namespace {

using namespace vitrine;

constexpr auto features = templates::legs_features("thigh_left", "thigh_right");

// Left halves, as means over flat-lay photos; the right half is the mirror image.
constexpr vitrine_pose_point brief_half[] = {
    {"waist_left", 0.170, 0.020, 0.12},
    {"hem_outer_left", 0.005, 0.810, 0.12},
    {"hem_inner_left", 0.440, 0.990, 0.13},
    {"crotch", 0.500, 0.860, 0.13},
};
constexpr auto brief = sdk::symmetric_pose(features, brief_half);
constexpr vitrine_pose_point straight_half[] = {
    {"waist_left", 0.130, 0.012, 0.12},
    {"hem_outer_left", 0.005, 0.930, 0.12},
    {"hem_inner_left", 0.465, 0.992, 0.13},
    {"crotch", 0.500, 0.750, 0.13},
};
constexpr auto straight = sdk::symmetric_pose(features, straight_half);
constexpr vitrine_pose_point flared_half[] = {
    {"waist_left", 0.175, 0.012, 0.12},
    {"hem_outer_left", 0.005, 0.960, 0.12},
    {"hem_inner_left", 0.460, 0.985, 0.13},
    {"crotch", 0.500, 0.650, 0.13},
};
constexpr auto flared = sdk::symmetric_pose(features, flared_half);
constexpr vitrine_pose_point spread_half[] = {
    {"waist_left", 0.130, 0.010, 0.12},
    {"hem_outer_left", 0.005, 0.915, 0.12},
    {"hem_inner_left", 0.440, 0.995, 0.13},
    {"crotch", 0.500, 0.585, 0.13},
};
constexpr auto spread = sdk::symmetric_pose(features, spread_half);
constexpr vitrine_pose_point bermuda_half[] = {
    {"waist_left", 0.185, 0.010, 0.12},
    {"hem_outer_left", 0.005, 0.945, 0.12},
    {"hem_inner_left", 0.430, 0.992, 0.13},
    {"crotch", 0.500, 0.510, 0.13},
};
constexpr auto bermuda = sdk::symmetric_pose(features, bermuda_half);
constexpr std::array<vitrine_pose, 5> poses = {{
    {"brief", sdk::span(brief)},
    {"straight", sdk::span(straight)},
    {"flared", sdk::span(flared)},
    {"spread", sdk::span(spread)},
    {"bermuda", sdk::span(bermuda)},
}};

constexpr std::array<vitrine_name, 2> leg_left = {{{"thigh_left"}, {"knee_left"}}};
constexpr std::array<vitrine_name, 2> leg_right = {{{"thigh_right"}, {"knee_right"}}};
constexpr auto limbs = templates::legs_limbs(sdk::span(leg_left), sdk::span(leg_right));

constexpr vitrine_scale_rule scale = {"waist_left", "waist_right", "waist", 0.97, "waist_left", "hem_outer_left"};
constexpr auto fabrics = std::array{templates::cotton_woven, templates::denim,      templates::wool_twill,
                                    templates::jersey,       templates::sweatshirt, templates::satin};

constexpr std::array<vitrine_garment, 1> garments = {{{.id = "shorts",
                                                       .title = "Shorts",
                                                       .features = sdk::span(features),
                                                       .poses = sdk::span(poses),
                                                       .edges = sdk::span(templates::legs_edges),
                                                       .seams = sdk::span(templates::legs_seams),
                                                       .limbs = sdk::span(limbs),
                                                       .scale = sdk::span_one(scale),
                                                       .anchors = sdk::span(templates::legs_anchors),
                                                       .fabrics = sdk::span(fabrics)}}};
static_assert(sdk::check(garments[0]));

}  // namespace

VITRINE_PLUGIN(.vendor = "Vitrine", .id = "org.vitrine.shorts", .version = "0.1.0",
               .garments = vitrine::sdk::span(garments), .necklines = {}, .extension = nullptr);
