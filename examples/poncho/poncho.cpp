// Poncho: one wide piece in front and one behind, sewn along the shoulders; its sides are open and hang over the arms.
#include "vitrine/check.hpp"
#include "vitrine/templates/fabrics.hpp"

namespace {

namespace sdk = vitrine::sdk;

// The corners of the outline, clockwise in the front photo: name, landmark of the body, partner on the other side, and
// which way the outline turns there.
constexpr auto features = std::to_array<vitrine_feature>({
    {"neck_left", "neck_left", "neck_right", VITRINE_TURN_CONVEX, 0},
    {"neck_right", "neck_right", "neck_left", VITRINE_TURN_CONVEX, 0},
    {"tip_right", nullptr, "tip_left", VITRINE_TURN_CONVEX, 0},
    {"hem_right", "hip_right", "hem_left", VITRINE_TURN_CONVEX, 0},
    {"hem_left", "hip_left", "hem_right", VITRINE_TURN_CONVEX, 0},
    {"tip_left", nullptr, "tip_right", VITRINE_TURN_CONVEX, 0},
});

// Where they lie in the garment's bounding box, (0,0) top left to (1,1) bottom right, and how far around to look, as a
// share of the box's diagonal. Left half; the right one is its mirror image.
constexpr vitrine_pose_point flat_half[] = {
    {"neck_left", 0.410, 0.005, 0.10},
    {"tip_left", 0.005, 0.255, 0.14},
    {"hem_left", 0.020, 0.985, 0.14},
};
constexpr auto flat = sdk::symmetric_pose(features, flat_half);
constexpr auto poses = std::to_array<vitrine_pose>({{"flat", sdk::span(flat)}});

// The outline from corner to corner, closed, and what each stretch is: sewn, open, or the neck.
constexpr auto edges = std::to_array<vitrine_edge>({
    {"neck", "neck_left", "neck_right", VITRINE_EDGE_NECK, 0},
    {"shoulder_line_right", "neck_right", "tip_right", VITRINE_EDGE_SEAM, 0},
    {"side_right", "tip_right", "hem_right", VITRINE_EDGE_OPEN, 0},
    {"hem", "hem_right", "hem_left", VITRINE_EDGE_OPEN, 0},
    {"side_left", "hem_left", "tip_left", VITRINE_EDGE_OPEN, 0},
    {"shoulder_line_left", "tip_left", "neck_left", VITRINE_EDGE_SEAM, 0},
});

// Front to back, edge by edge.
constexpr auto seams = std::to_array<vitrine_seam>({
    {"shoulder_line_right", "shoulder_line_right", VITRINE_SIDE_FRONT, VITRINE_SIDE_BACK, 0, 0},
    {"shoulder_line_left", "shoulder_line_left", VITRINE_SIDE_FRONT, VITRINE_SIDE_BACK, 0, 0},
});

// Twice the distance of the first two features is the body's bust times 2.2; the length is measured between the others.
constexpr vitrine_scale_rule scale = {"tip_left", "tip_right", "bust", 2.2, "neck_left", "hem_left"};

// What hangs at the height of its landmark.
constexpr auto anchors = std::to_array<vitrine_name>({{"neck_left"}, {"neck_right"}});

// What it may be made of; the first is the default.
constexpr auto fabrics = std::array{vitrine::templates::wool_twill, vitrine::templates::jersey};

constexpr auto garments = std::to_array<vitrine_garment>({{
    .id = "poncho",
    .title = "Poncho",
    .features = sdk::span(features),
    .poses = sdk::span(poses),
    .edges = sdk::span(edges),
    .seams = sdk::span(seams),
    .limbs = {},
    .scale = sdk::span_one(scale),
    .anchors = sdk::span(anchors),
    .fabrics = sdk::span(fabrics),
}});
VITRINE_CHECK(garments[0]);

}  // namespace

VITRINE_PLUGIN(.vendor = "Example", .id = "org.example.poncho", .version = "1.0.0",
               .garments = vitrine::sdk::span(garments), .necklines = {}, .extension = nullptr);
