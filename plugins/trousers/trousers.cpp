// SPDX-License-Identifier: MIT
// Long trousers, from jeans to palazzo.
#include "vitrine/check.hpp"
#include "vitrine/templates/fabrics.hpp"
#include "vitrine/templates/legs.hpp"

namespace {

using namespace vitrine;

constexpr auto features = templates::legs_features("ankle_left", "ankle_right");

// Left halves, as means over flat-lay photos; the right half is the mirror image.
constexpr vitrine_pose_point straight_half[] = {
    {"waist_left", 0.100, 0.008, 0.12},
    {"hem_outer_left", 0.015, 0.978, 0.12},
    {"hem_inner_left", 0.415, 0.995, 0.13},
    {"crotch", 0.500, 0.285, 0.13},
};
constexpr auto straight = sdk::symmetric_pose(features, straight_half);
constexpr vitrine_pose_point spread_half[] = {
    {"waist_left", 0.130, 0.008, 0.12},
    {"hem_outer_left", 0.008, 0.966, 0.12},
    {"hem_inner_left", 0.290, 0.995, 0.13},
    {"crotch", 0.500, 0.270, 0.13},
};
constexpr auto spread = sdk::symmetric_pose(features, spread_half);
constexpr vitrine_pose_point spread_wide_half[] = {
    {"waist_left", 0.270, 0.010, 0.12},
    {"hem_outer_left", 0.015, 0.960, 0.12},
    {"hem_inner_left", 0.210, 0.990, 0.13},
    {"crotch", 0.500, 0.320, 0.13},
};
constexpr auto spread_wide = sdk::symmetric_pose(features, spread_wide_half);
constexpr vitrine_pose_point tapered_half[] = {
    {"waist_left", 0.088, 0.008, 0.12},
    {"hem_outer_left", 0.110, 0.982, 0.12},
    {"hem_inner_left", 0.415, 0.995, 0.13},
    {"crotch", 0.500, 0.280, 0.13},
};
constexpr auto tapered = sdk::symmetric_pose(features, tapered_half);
constexpr vitrine_pose_point wide_half[] = {
    {"waist_left", 0.240, 0.015, 0.12},
    {"hem_outer_left", 0.005, 0.965, 0.12},
    {"hem_inner_left", 0.420, 0.995, 0.13},
    {"crotch", 0.500, 0.275, 0.13},
};
constexpr auto wide = sdk::symmetric_pose(features, wide_half);
constexpr vitrine_pose_point cropped_half[] = {
    {"waist_left", 0.220, 0.015, 0.12},
    {"hem_outer_left", 0.005, 0.960, 0.12},
    {"hem_inner_left", 0.400, 0.990, 0.13},
    {"crotch", 0.500, 0.400, 0.13},
};
constexpr auto cropped = sdk::symmetric_pose(features, cropped_half);
constexpr std::array<vitrine_pose, 6> poses = {{
    {"straight", sdk::span(straight)},
    {"spread", sdk::span(spread)},
    {"spread_wide", sdk::span(spread_wide)},
    {"tapered", sdk::span(tapered)},
    {"wide", sdk::span(wide)},
    {"cropped", sdk::span(cropped)},
}};

constexpr std::array<vitrine_name, 3> leg_left = {{{"thigh_left"}, {"knee_left"}, {"ankle_left"}}};
constexpr std::array<vitrine_name, 3> leg_right = {{{"thigh_right"}, {"knee_right"}, {"ankle_right"}}};
constexpr auto limbs = templates::legs_limbs(sdk::span(leg_left), sdk::span(leg_right));

constexpr vitrine_scale_rule scale = {"waist_left", "waist_right", "waist", 0.97, "waist_left", "hem_outer_left"};
constexpr auto fabrics = std::array{templates::cotton_woven, templates::denim,      templates::wool_twill,
                                    templates::jersey,       templates::sweatshirt, templates::satin};

constexpr std::array<vitrine_garment, 1> garments = {{{.id = "trousers",
                                                       .title = "Trousers",
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

VITRINE_PLUGIN(.vendor = "Vitrine", .id = "org.vitrine.trousers", .version = "0.1.0",
               .garments = vitrine::sdk::span(garments), .necklines = {}, .extension = nullptr);
