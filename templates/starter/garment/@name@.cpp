// @Title@: a garment as data. It starts as a sleeveless top; change the tables until they describe yours.
#include "vitrine/check.hpp"
#include "vitrine/templates/fabrics.hpp"

namespace {

namespace sdk = vitrine::sdk;

// The corners of the outline, clockwise in the front photo: name, landmark of the body, partner on the other side, and
// which way the outline turns there.
constexpr auto features = std::to_array<vitrine_feature>({
    {"neck_left", "neck_left", "neck_right", VITRINE_TURN_CONVEX, 0},
    {"neck_right", "neck_right", "neck_left", VITRINE_TURN_CONVEX, 0},
    {"shoulder_right", "shoulder_right", "shoulder_left", VITRINE_TURN_CONVEX, 0},
    {"armpit_right", "armpit_right", "armpit_left", VITRINE_TURN_CONVEX, 0},
    {"hem_right", "hip_right", "hem_left", VITRINE_TURN_CONVEX, 0},
    {"hem_left", "hip_left", "hem_right", VITRINE_TURN_CONVEX, 0},
    {"armpit_left", "armpit_left", "armpit_right", VITRINE_TURN_CONVEX, 0},
    {"shoulder_left", "shoulder_left", "shoulder_right", VITRINE_TURN_CONVEX, 0},
});

// Where they lie in the garment's bounding box, (0,0) top left to (1,1) bottom right, and how far around to look, as a
// share of the box's diagonal. Left half; the right one is its mirror image.
constexpr vitrine_pose_point flat_half[] = {
    {"neck_left", 0.300, 0.005, 0.10},
    {"shoulder_left", 0.155, 0.030, 0.10},
    {"armpit_left", 0.030, 0.335, 0.12},
    {"hem_left", 0.010, 0.980, 0.12},
};
constexpr auto flat = sdk::symmetric_pose(features, flat_half);
constexpr auto poses = std::to_array<vitrine_pose>({{"flat", sdk::span(flat)}});

// The outline from corner to corner, closed, and what each stretch is: sewn, open, or the neck.
constexpr auto edges = std::to_array<vitrine_edge>({
    {"neck", "neck_left", "neck_right", VITRINE_EDGE_NECK, 0},
    {"shoulder_line_right", "neck_right", "shoulder_right", VITRINE_EDGE_SEAM, 0},
    {"armhole_right", "shoulder_right", "armpit_right", VITRINE_EDGE_OPEN, 0},
    {"side_right", "armpit_right", "hem_right", VITRINE_EDGE_SEAM, 0},
    {"hem", "hem_right", "hem_left", VITRINE_EDGE_OPEN, 0},
    {"side_left", "hem_left", "armpit_left", VITRINE_EDGE_SEAM, 0},
    {"armhole_left", "armpit_left", "shoulder_left", VITRINE_EDGE_OPEN, 0},
    {"shoulder_line_left", "shoulder_left", "neck_left", VITRINE_EDGE_SEAM, 0},
});

// Front to back, edge by edge.
constexpr auto seams = std::to_array<vitrine_seam>({
    {"shoulder_line_right", "shoulder_line_right", VITRINE_SIDE_FRONT, VITRINE_SIDE_BACK, 0, 0},
    {"side_right", "side_right", VITRINE_SIDE_FRONT, VITRINE_SIDE_BACK, 0, 0},
    {"side_left", "side_left", VITRINE_SIDE_FRONT, VITRINE_SIDE_BACK, 0, 0},
    {"shoulder_line_left", "shoulder_line_left", VITRINE_SIDE_FRONT, VITRINE_SIDE_BACK, 0, 0},
});

// Twice the distance of the first two features is the body's bust times 1.06; the length is measured between the others.
constexpr vitrine_scale_rule scale = {"armpit_left", "armpit_right", "bust", 1.06, "neck_left", "hem_left"};

// What hangs at the height of its landmark.
constexpr auto anchors = std::to_array<vitrine_name>({{"neck_left"}, {"neck_right"}});

// What it may be made of; the first is the default.
constexpr auto fabrics = std::array{vitrine::templates::cotton_woven, vitrine::templates::jersey};

constexpr auto garments = std::to_array<vitrine_garment>({{
    .id = "@name@",
    .title = "@Title@",
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

VITRINE_PLUGIN(.vendor = "Example", .id = "org.example.@name@", .version = "1.0.0",
               .garments = vitrine::sdk::span(garments), .necklines = {}, .extension = nullptr);
