// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <random>
#include <regex>

#include "mesh_check.hpp"
#include "shapes.hpp"
#include "slice.hpp"

namespace vitrine {
namespace {

struct Person {
  const char* name;
  Measurements size;
};

// sex, height, bust, under_bust, waist, hip, inside_leg, arm, neck_base [m]
const Person people[] = {
    {"default", {}},
    {"petite", {"woman", 1.52, 0.80, 0.70, 0.62, 0.86, 0.71, 0.50, 0.33}},
    {"plus", {"woman", 1.65, 1.24, 1.05, 1.10, 1.26, 0.77, 0.55, 0.40}},
    {"waist_above_hip", {"woman", 1.62, 1.10, 1.00, 1.14, 1.08, 0.77, 0.54, 0.39}},
    {"tall", {"woman", 1.90, 0.92, 0.79, 0.72, 0.98, 0.93, 0.64, 0.38}},
    {"under_bust_above_bust", {"woman", 1.68, 0.88, 0.90, 0.80, 0.96, 0.80, 0.56, 0.37}},
    {"man", {"man", 1.78, 1.00, 0.95, 0.84, 0.98, 0.83, 0.60, 0.42}},
    {"heavy_man", {"man", 1.76, 1.22, 1.16, 1.24, 1.16, 0.80, 0.59, 0.48}},
    {"small_corner", {"woman", 1.40, 0.70, 0.60, 0.55, 0.78, 0.574, 0.392, 0.30}},
    {"large_corner", {"woman", 1.70, 1.50, 1.30, 1.45, 1.50, 0.78, 0.56, 0.46}},
    {"long_legs", {"man", 2.10, 1.10, 1.04, 0.95, 1.10, 1.113, 0.819, 0.46}},
};

const Mannequin& body_of(const Person& person) {
  static std::map<std::string, Mannequin> made;
  auto found = made.find(person.name);
  if (found == made.end()) {
    Result<Mannequin> body = build_mannequin(person.size);
    if (!body) ADD_FAILURE() << person.name << ": " << body.error().message;
    found = made.emplace(person.name, body ? *body : Mannequin{}).first;
  }
  return found->second;
}

class BuiltBody : public testing::TestWithParam<Person> {
 protected:
  const Mannequin& body = body_of(GetParam());
  const Measurements& asked = GetParam().size;
  Vec3 at(const std::string& name) const { return body.landmarks.at(name); }
};

INSTANTIATE_TEST_SUITE_P(people, BuiltBody, testing::ValuesIn(people),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(BuiltBody, is_one_closed_manifold_that_faces_outward) {
  const body::MeshState state = body::inspect(body.mesh);
  EXPECT_TRUE(state.finite && state.valid_indices);
  EXPECT_EQ(state.open_edges, 0u);
  EXPECT_EQ(state.crowded_edges, 0u);
  EXPECT_EQ(state.turned_edges, 0u);
  EXPECT_EQ(state.parts, 1u);
  EXPECT_GT(body::signed_volume(body.mesh), 0.015);
  EXPECT_GE(body.mesh.triangles.size(), 8000u);
  EXPECT_LE(body.mesh.triangles.size(), 40000u);
  // A sphere's Euler number: no handles where hands, thighs or arms would have grown together.
  EXPECT_EQ(body.mesh.vertices.size() * 2, body.mesh.triangles.size() + 4);
}

TEST_P(BuiltBody, has_the_girths_that_were_asked_for) {
  const auto girth = [&](const char* name) { return body.girths.at(name) * 1e3; };
  EXPECT_NEAR(girth("bust"), asked.bust * 1e3, 3);
  EXPECT_NEAR(girth("under_bust"), asked.under_bust * 1e3, 3);
  EXPECT_NEAR(girth("waist"), asked.waist * 1e3, 3);
  EXPECT_NEAR(girth("hip"), asked.hip * 1e3, 3);
  EXPECT_NEAR(girth("neck_base"), asked.neck_base * 1e3, 4);
  EXPECT_NEAR(girth("height"), asked.height * 1e3, 1);
  EXPECT_NEAR(girth("inside_leg"), asked.inside_leg * 1e3, 3);
  EXPECT_NEAR(girth("arm"), asked.arm * 1e3, 1);
  for (const char* name : {"biceps", "wrist", "thigh"}) EXPECT_GT(girth(name), 90) << name;
}

TEST_P(BuiltBody, stands_on_the_floor_in_the_middle) {
  Vec3 low = Vec3::Constant(9), high = -low;
  for (const Vec3& v : body.mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  EXPECT_NEAR(low.y(), 0, 1e-9);
  EXPECT_NEAR(high.y(), asked.height, 1e-3);
  EXPECT_NEAR(low.x() + high.x(), 0, 2e-3);
}

TEST_P(BuiltBody, keeps_its_arms_off_the_trunk_at_the_bust) {
  const Vec3 bust = at("bust_right");
  const std::vector<body::Ring> rings = body::slice(body.mesh, Vec3(0, bust.y(), 0), Vec3::UnitY());
  ASSERT_GE(rings.size(), 3u) << "trunk and two arms";
  EXPECT_TRUE(rings[0].holds(Vec3(0, bust.y(), 0.01)));
  EXPECT_GT(rings[1].low.x() > 0 ? rings[1].low.x() : -rings[1].high.x(), rings[0].high.x() + 0.002);
}

TEST_P(BuiltBody, keeps_its_legs_apart_below_the_crotch) {
  const double crotch = at("crotch").y();
  for (const double share : {0.985, 0.9, 0.7, 0.5, 0.3, 0.1}) {
    int legs = 0;
    for (const body::Ring& ring : body::slice(body.mesh, Vec3(0, share * crotch, 0), Vec3::UnitY())) {
      EXPECT_GT(ring.low.x() * ring.high.x(), 0) << "nothing spans the middle at " << share;
      if (std::abs(ring.centre.x()) < 0.13 * asked.height) ++legs;
    }
    EXPECT_EQ(legs, 2) << share;
  }
}

TEST_P(BuiltBody, has_every_landmark_in_order_of_height) {
  for (const char* name :
       {"neck_left",    "neck_right",  "neck_front", "neck_back",   "shoulder_left", "shoulder_right", "armpit_left",
        "armpit_right", "bust_left",   "bust_right", "under_bust",  "waist",         "waist_left",     "waist_right",
        "hip",          "hip_left",    "hip_right",  "biceps_left", "biceps_right",  "elbow_left",     "elbow_right",
        "wrist_left",   "wrist_right", "crotch",     "thigh_left",  "thigh_right",   "knee_left",      "knee_right",
        "ankle_left",   "ankle_right", "crown"})
    ASSERT_TRUE(body.landmarks.count(name) == 1 && body.landmarks.at(name).allFinite()) << name;
  const char* order[] = {"ankle_right", "knee_right", "thigh_right",  "crotch",         "hip",        "waist",
                         "under_bust",  "bust_right", "armpit_right", "shoulder_right", "neck_right", "crown"};
  for (std::size_t i = 0; i + 1 < std::size(order); ++i) EXPECT_LT(at(order[i]).y(), at(order[i + 1]).y()) << order[i];
  EXPECT_LT(at("neck_front").y(), at("neck_right").y());
  EXPECT_LT(at("neck_right").y(), at("neck_back").y());
  EXPECT_GT(at("shoulder_right").y(), at("elbow_right").y());
  EXPECT_GT(at("elbow_right").y(), at("wrist_right").y());
  EXPECT_LT(at("neck_right").x() + 0.05, at("shoulder_right").x());
  for (const char* name :
       {"neck", "shoulder", "armpit", "bust", "waist", "hip", "elbow", "wrist", "thigh", "knee", "ankle"}) {
    const Vec3 l = at(std::string(name) + "_left"), r = at(std::string(name) + "_right");
    EXPECT_LT(l.x(), 0) << name;
    EXPECT_LT((Vec3(-l.x(), l.y(), l.z()) - r).norm(), 1e-9) << name;
  }
}

TEST_P(BuiltBody, has_surface_landmarks_on_the_skin_and_joints_inside) {
  const Result<DistanceField> field = voxelise(body.mesh, {0.008, 0.03});
  ASSERT_TRUE(field);
  for (const char* name : {"neck_left", "neck_right", "neck_front", "neck_back", "shoulder_left", "armpit_right",
                           "bust_left", "under_bust", "waist", "waist_left", "hip", "hip_right", "crown"})
    // The armpit is a tight corner that triangles cut.
    EXPECT_NEAR(field->distance(at(name)), 0, std::string(name) == "armpit_right" ? 0.010 : 0.004) << name;
  for (const char* name : {"biceps_left", "elbow_left", "elbow_right", "wrist_left", "wrist_right", "thigh_left",
                           "knee_left", "ankle_right"})
    EXPECT_LT(field->distance(at(name)), -0.012) << name;
}

TEST_P(BuiltBody, is_its_own_mirror_image) {
  const Result<DistanceField> field = voxelise(body.mesh, {0.008, 0.03});
  ASSERT_TRUE(field);
  double worst = 0;
  for (const Vec3& v : body.mesh.vertices)
    worst = std::max(worst, std::abs(field->distance(Vec3(-v.x(), v.y(), v.z())) - field->distance(v)));
  // The largest body has the longest edges, and chords differ from side to side by their sag.
  EXPECT_LT(worst, std::string(GetParam().name) == "large_corner" ? 0.008 : 0.006);
}

TEST_P(BuiltBody, has_no_needle_triangles) {
  std::size_t thin = 0;
  for (const Triangle& t : body.mesh.triangles) {
    const Vec3 &a = body.mesh.vertices[t[0]], &b = body.mesh.vertices[t[1]], &c = body.mesh.vertices[t[2]];
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    if ((b - a).cross(c - a).norm() < 0.2 * longest * longest) ++thin;
  }
  EXPECT_LT(thin, body.mesh.triangles.size() / 200);
}

TEST(BuildMannequin, gives_the_same_bytes_twice) {
  const Result<Mannequin> a = build_mannequin({}), b = build_mannequin({});
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->mesh.vertices.size(), b->mesh.vertices.size());
  EXPECT_EQ(0, std::memcmp(a->mesh.vertices.data(), b->mesh.vertices.data(), a->mesh.vertices.size() * sizeof(Vec3)));
  EXPECT_EQ(a->mesh.triangles, b->mesh.triangles);
  EXPECT_EQ(a->girths, b->girths);
}

TEST(BuildMannequin, names_the_measurement_it_refuses_and_the_range) {
  const auto refused = [](const char* name, double Measurements::*field, double value) {
    Measurements m;
    m.*field = value;
    const Result<Mannequin> body = build_mannequin(m);
    ASSERT_FALSE(body) << name;
    EXPECT_EQ(body.error().code, "IMPLAUSIBLE_MEASUREMENTS");
    EXPECT_EQ(body.error().exit_code(), 65);
    EXPECT_THAT(body.error().message, testing::HasSubstr(name));
    EXPECT_THAT(body.error().message, testing::ContainsRegex("[0-9]+ to [0-9]+ mm"));
  };
  refused("height", &Measurements::height, 1.3);
  refused("height", &Measurements::height, 172);
  refused("bust", &Measurements::bust, 0.65);
  refused("under_bust", &Measurements::under_bust, 0.95);
  refused("waist", &Measurements::waist, 1.6);
  refused("hip", &Measurements::hip, 0.70);
  refused("inside_leg", &Measurements::inside_leg, 0.60);
  refused("arm", &Measurements::arm, 0.80);
  refused("neck_base", &Measurements::neck_base, 0.20);
  refused("bust", &Measurements::bust, std::nan(""));
}

TEST(BuildMannequin, refuses_an_unknown_sex) {
  Measurements m;
  m.sex = "robot";
  EXPECT_EQ(build_mannequin(m).error().code, "IMPLAUSIBLE_MEASUREMENTS");
}

TEST(BuildMannequin, holds_the_arms_in_an_a_pose) {
  const Result<Mannequin> body = build_mannequin({});
  ASSERT_TRUE(body);
  const Vec3 arm = body->landmarks.at("elbow_right") - body->landmarks.at("shoulder_right");
  const double angle = std::atan2(arm.x(), -arm.y()) * 57.29577951308232;
  EXPECT_GT(angle, 32);
  EXPECT_LT(angle, 48);
}

TEST(BuildMannequin, presets_meet_their_measurements_within_two_millimetres) {
  for (const char* name : {"woman-xs", "woman-s", "woman-m", "woman-l", "woman-xl", "woman-xxl", "man-xs", "man-s",
                           "man-m", "man-l", "man-xl", "man-xxl"}) {
    const Result<Measurements> m = preset_measurements(name);
    ASSERT_TRUE(m);
    const Result<Mannequin> body = build_mannequin(*m);
    ASSERT_TRUE(body) << name << ": " << body.error().message;
    const std::pair<const char*, double> asked[] = {
        {"height", m->height}, {"bust", m->bust}, {"under_bust", m->under_bust}, {"waist", m->waist},
        {"hip", m->hip},       {"arm", m->arm},   {"inside_leg", m->inside_leg}, {"neck_base", m->neck_base}};
    for (const auto& [size, value] : asked) EXPECT_NEAR(body->girths.at(size), value, 0.002) << name << ' ' << size;
    EXPECT_GE(body->mesh.triangles.size(), 10000u) << name;
    EXPECT_LE(body->mesh.triangles.size(), 20000u) << name;
  }
  EXPECT_EQ(preset_measurements("woman-xxxl").error().code, "UNKNOWN_PRESET");
}

TEST(BuildMannequin, names_unusual_measurements_and_leaves_usual_ones_alone) {
  Measurements m = *preset_measurements("woman-m");
  EXPECT_TRUE(unusual_measurements(m).empty());
  m.arm = 0.38 * m.height;
  const std::vector<std::string> unusual = unusual_measurements(m);
  ASSERT_EQ(unusual.size(), 1u);
  EXPECT_EQ(unusual.front().rfind("arm is 0.380 of the height", 0), 0u) << unusual.front();
}

/// Takes the advice of a refusal: the named measurement goes to the nearer end of the named range.
bool follow(const std::string& advice, Measurements& m) {
  static const std::regex outside("(\\w+) of \\d+ mm is outside (\\d+) to (\\d+) mm.*"),
      works("(\\w+) of \\d+ mm fits no body with these other measurements: (\\d+) to (\\d+) mm works.*");
  static const std::map<std::string, double Measurements::*> sizes{{"height", &Measurements::height},
                                                                   {"bust", &Measurements::bust},
                                                                   {"under_bust", &Measurements::under_bust},
                                                                   {"waist", &Measurements::waist},
                                                                   {"hip", &Measurements::hip},
                                                                   {"inside_leg", &Measurements::inside_leg},
                                                                   {"arm", &Measurements::arm},
                                                                   {"neck_base", &Measurements::neck_base}};
  std::smatch found;
  if (!std::regex_match(advice, found, outside) && !std::regex_match(advice, found, works)) return false;
  double& value = m.*sizes.at(found[1]);
  const double low = std::stod(found[2]) * 1e-3, high = std::stod(found[3]) * 1e-3;
  if (low > high) return false;
  value = std::clamp(value, low, high);
  return true;
}

TEST(BuildMannequin, builds_what_it_accepts_or_says_what_would_work_and_that_is_true) {
  std::mt19937_64 random(5);
  const auto between = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1.0p-53;
  };
  int built = 0, advised = 0;
  for (int i = 0; i < 40; ++i) {
    Measurements m;
    m.sex = i % 2 == 0 ? "woman" : "man";
    m.height = between(1.4, 2.1);
    m.bust = between(0.7, 1.5);
    m.under_bust = between(std::max(0.6, m.bust - 0.35), std::min(1.3, m.bust));
    m.waist = between(std::max(0.55, m.bust - 0.4), std::min(1.45, m.bust + 0.25));
    m.hip = between(std::max(0.78, m.bust - 0.3), std::min(1.5, m.bust + 0.4));
    m.inside_leg = m.height * between(0.42, 0.53);
    m.arm = m.height * between(0.28, 0.39);
    m.neck_base = between(0.30, 0.56);
    Result<Mannequin> body = build_mannequin(m);
    if (body) ++built;
    for (int steps = 0; !body && steps < 6; ++steps) {
      ASSERT_EQ(body.error().code, "IMPLAUSIBLE_MEASUREMENTS") << body.error().message;
      ASSERT_TRUE(follow(body.error().message, m)) << body.error().message;
      body = build_mannequin(m);
      ++advised;
    }
    ASSERT_TRUE(body) << body.error().message;
    const std::pair<const char*, double> asked[] = {
        {"bust", m.bust}, {"under_bust", m.under_bust}, {"waist", m.waist},   {"hip", m.hip},
        {"arm", m.arm},   {"inside_leg", m.inside_leg}, {"height", m.height}, {"neck_base", m.neck_base}};
    for (const auto& [size, value] : asked) EXPECT_NEAR(body->girths.at(size), value, 0.005) << size;
    for (const auto& [name, at] : body->landmarks) EXPECT_TRUE(at.allFinite()) << name;
  }
  EXPECT_GT(built, 20);
  EXPECT_GT(advised, 0);
}

}  // namespace
}  // namespace vitrine
