// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

using namespace vitrine;

namespace {

double capsule(const Vec3& p, const Vec3& a, const Vec3& b, double r) {
  const Vec3 d = b - a;
  const double t = std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
  return (p - a - t * d).norm() - r;
}

const Vec3 shoulder(0.17, 1.40, 0), elbow(0.37, 1.18, 0), wrist(0.53, 1.00, 0);
Vec3 mirrored(Vec3 v) {
  return {-v.x(), v.y(), v.z()};
}

/// A trunk with two straight arms, at about 42 degrees from the vertical if not told; landmarks of a long sleeve.
struct Doll {
  Mannequin mannequin;
  DistanceField field;
  explicit Doll(const Vec3& elbow = ::elbow, const Vec3& wrist = ::wrist) {
    for (const double y : {0.0, 1.7}) mannequin.mesh.vertices.push_back(Vec3(0, y, 0));
    auto& l = mannequin.landmarks;
    l["neck_left"] = Vec3(-0.06, 1.46, 0);
    l["neck_right"] = Vec3(0.06, 1.46, 0);
    l["shoulder_right"] = shoulder, l["elbow_right"] = elbow, l["wrist_right"] = wrist;
    l["shoulder_left"] = mirrored(shoulder), l["elbow_left"] = mirrored(elbow), l["wrist_left"] = mirrored(wrist);
    field.spacing = 0.01;
    field.origin = Vec3(-0.8, 0.5, -0.4);
    field.size = {161, 121, 81};
    for (int z = 0; z < field.size[2]; ++z)
      for (int y = 0; y < field.size[1]; ++y)
        for (int x = 0; x < field.size[0]; ++x) {
          const Vec3 p = field.origin + field.spacing * Vec3(x, y, z);
          double d = capsule(p, Vec3(0, 0.8, 0), Vec3(0, 1.35, 0), 0.14);
          for (const bool left : {false, true}) {
            const Vec3 q = left ? mirrored(p) : p;
            d = std::min({d, capsule(q, shoulder, elbow, 0.045), capsule(q, elbow, wrist, 0.04)});
          }
          field.values.push_back(static_cast<float>(d));
        }
  }
};

/// A long-sleeve outline whose sleeves hang at `degrees` from the vertical; nodes on the outline only.
struct Shirt {
  GarmentTemplate garment;
  Pattern pattern;
  explicit Shirt(double degrees) {
    const double a = degrees * M_PI / 180;
    const Vec2 along(std::sin(a), -std::cos(a)), across(std::cos(a), std::sin(a));
    const Vec2 armpit(0.24, -0.22), top(0.20, -0.03);
    const Vec2 lower = armpit + 0.40 * along, upper = lower + 0.13 * across;
    // Clockwise in the picture is the template's order; the panel's outline runs the other way.
    const std::vector<std::pair<std::string, Vec2>> right{{"neck", {0.08, 0}},   {"shoulder", top},
                                                          {"cuff_upper", upper}, {"cuff_lower", lower},
                                                          {"armpit", armpit},    {"hem", {0.25, -0.6}}};
    std::vector<std::pair<std::string, Vec2>> loop;
    for (const auto& [name, p] : right) loop.emplace_back(name + "_left", Vec2(-p.x(), p.y()));
    for (std::size_t i = right.size(); i-- > 0;) loop.emplace_back(right[i].first + "_right", right[i].second);
    Panel panel;
    std::map<std::string, int> index;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 from = loop[i].second, to = loop[(i + 1) % loop.size()].second;
      index[loop[i].first] = static_cast<int>(garment.features.size());
      TemplateFeature feature;
      feature.name = loop[i].first;
      garment.features.push_back(feature);
      panel.corner.push_back(static_cast<int>(panel.outline.size()));
      for (int k = 0; k < 8; ++k) panel.outline.push_back(from + (to - from) * k / 8.0);
    }
    for (const std::string side : {"_left", "_right"}) {
      garment.features[index["neck" + side]].landmark = "neck" + side;
      garment.anchors.push_back(index["neck" + side]);
      garment.limbs.push_back({"sleeve" + side,
                               index["shoulder" + side],
                               index["armpit" + side],
                               index["cuff_upper" + side],
                               index["cuff_lower" + side],
                               {"shoulder" + side, "elbow" + side, "wrist" + side}});
    }
    for (const Side side : {Side::front, Side::back}) {
      panel.side = side;
      pattern.panels.push_back(panel);
      pattern.meshes.push_back({panel.outline, {}});
    }
  }
  Vec3 corner(const Placement& placed, int panel, const std::string& name) const {
    for (std::size_t i = 0; i < garment.features.size(); ++i)
      if (garment.features[i].name == name) return placed[panel][pattern.panels[panel].corner[i]];
    return Vec3::Zero();
  }
};

}  // namespace

TEST(Fit, panels_stand_before_and_behind_and_clear_of_the_body) {
  const Doll doll;
  const Shirt shirt(30);
  const auto placed = place_panels(shirt.garment, shirt.pattern, doll.mannequin, doll.field);
  ASSERT_TRUE(placed);
  for (int panel = 0; panel < 2; ++panel)
    for (const Vec3& q : (*placed)[panel]) {
      // A sleeve's half tube ends on the arm's own middle, which the voxels give to a millimetre.
      EXPECT_GT(q.z() * (panel == 0 ? 1 : -1), -0.001);
      EXPECT_GE(doll.field.distance(q), 0.009);
    }
}

TEST(Fit, sleeves_of_any_spread_follow_the_arms) {
  const Doll doll;
  for (const double degrees : {8.0, 30.0, 42.0, 70.0, 85.0}) {
    const Shirt shirt(degrees);
    const auto placed = place_panels(shirt.garment, shirt.pattern, doll.mannequin, doll.field);
    ASSERT_TRUE(placed);
    const Vec3 cuff = (shirt.corner(*placed, 0, "cuff_upper_right") + shirt.corner(*placed, 0, "cuff_lower_right")) / 2;
    const Vec2 arm = (wrist - elbow).head<2>().normalized(), off = cuff.head<2>() - wrist.head<2>();
    EXPECT_LT(std::abs(off.x() * arm.y() - off.y() * arm.x()), 0.02)
        << "cuff beside the arm at " << degrees << " degrees";
  }
}

TEST(Fit, mirrored_panels_are_placed_mirrored) {
  const Doll doll;
  const Shirt shirt(25);
  const auto placed = place_panels(shirt.garment, shirt.pattern, doll.mannequin, doll.field);
  ASSERT_TRUE(placed);
  for (const char* name : {"neck", "shoulder", "cuff_upper", "cuff_lower", "armpit", "hem"}) {
    const Vec3 l = shirt.corner(*placed, 0, std::string(name) + "_left"),
               r = shirt.corner(*placed, 0, std::string(name) + "_right");
    // The middle of each arm is found on the voxels, to a millimetre.
    EXPECT_NEAR(l.x(), -r.x(), 1e-3) << name;
    EXPECT_NEAR(l.y(), r.y(), 1e-3) << name;
  }
}

TEST(Fit, the_trunk_keeps_its_flat_shape) {
  const Doll doll;
  const Shirt shirt(8);
  const auto placed = place_panels(shirt.garment, shirt.pattern, doll.mannequin, doll.field);
  ASSERT_TRUE(placed);
  const double width = (shirt.corner(*placed, 0, "hem_right") - shirt.corner(*placed, 0, "hem_left")).head<2>().norm();
  EXPECT_NEAR(width, 0.50, 1e-9);
}

TEST(Fit, sides_hang_between_trunk_and_arms_however_close_the_arms_are) {
  GarmentTemplate garment;
  Panel panel;
  const std::vector<std::pair<std::string, Vec2>> corners{
      {"neck_left", {-0.1, 0}},    {"armpit_left", {-0.25, -0.2}}, {"hem_left", {-0.25, -0.6}},
      {"hem_right", {0.25, -0.6}}, {"armpit_right", {0.25, -0.2}}, {"neck_right", {0.1, 0}}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& [name, from] = corners[i];
    const Vec2 to = corners[(i + 1) % corners.size()].second;
    garment.features.push_back({name, name, -1, Turn::any});
    panel.corner.push_back(static_cast<int>(panel.outline.size()));
    for (int k = 0; k < 12; ++k) panel.outline.push_back(from + (to - from) * k / 12.0);
  }
  garment.anchors = {0, 5};
  Pattern pattern;
  for (const Side side : {Side::front, Side::back}) {
    panel.side = side;
    pattern.panels.push_back(panel);
    pattern.meshes.push_back({panel.outline, {}});
  }
  for (const double degrees : {25.0, 32.0, 42.0}) {
    const double a = degrees * M_PI / 180;
    const Vec3 along(std::sin(a), -std::cos(a), 0);
    const Doll doll(shoulder + 0.3 * along, shoulder + 0.55 * along);
    const auto placed = place_panels(garment, pattern, doll.mannequin, doll.field);
    ASSERT_TRUE(placed);
    int looked_at = 0;
    for (std::size_t i = 0; i < panel.outline.size(); ++i) {
      // The first centimetres under the armpit are narrower than the voxels tell.
      if (std::abs(panel.outline[i].x()) < 0.249 || panel.outline[i].y() > -0.22) continue;
      const Vec3 q = (*placed)[0][i];
      double least = 1;
      for (double z = -0.3; z <= 0.3; z += 0.01) least = std::min(least, doll.field.distance({q.x(), q.y(), z}));
      EXPECT_GT(least, 0) << degrees << " degrees, at height " << q.y();
      ++looked_at;
    }
    EXPECT_GT(looked_at, 15);
  }
}

// A poncho's sides are open: nothing has to pass below the arms, so the cloth is laid over them, as wide as it is.
TEST(Fit, sides_that_are_sewn_nowhere_hang_over_the_arms) {
  const Doll doll;
  Shirt cape(30);
  cape.garment.limbs.clear();
  const auto edge = [&](const std::string& name, const std::string& from, const std::string& to, EdgeKind kind) {
    TemplateEdge e{name, 0, 0, kind};
    for (std::size_t i = 0; i < cape.garment.features.size(); ++i) {
      if (cape.garment.features[i].name == from) e.from = static_cast<int>(i);
      if (cape.garment.features[i].name == to) e.to = static_cast<int>(i);
    }
    cape.garment.edges.push_back(e);
  };
  edge("neck", "neck_left", "neck_right", EdgeKind::neck);
  edge("shoulder_line_right", "neck_right", "cuff_upper_right", EdgeKind::seam);
  edge("rest", "cuff_upper_right", "cuff_upper_left", EdgeKind::open);
  edge("shoulder_line_left", "cuff_upper_left", "neck_left", EdgeKind::seam);
  const auto width = [&] {
    const auto placed = place_panels(cape.garment, cape.pattern, doll.mannequin, doll.field);
    EXPECT_TRUE(placed);
    return cape.corner(*placed, 0, "armpit_right").x() - cape.corner(*placed, 0, "armpit_left").x();
  };
  EXPECT_NEAR(width(), 0.48, 1e-9);
  // The same outline with a side seam passes between trunk and arms.
  cape.garment.edges[2].to = cape.garment.edges[1].from;
  edge("side", "armpit_right", "hem_right", EdgeKind::seam);
  edge("hem", "hem_right", "hem_left", EdgeKind::open);
  std::rotate(cape.garment.edges.begin() + 3, cape.garment.edges.begin() + 4, cape.garment.edges.end());
  EXPECT_LT(width(), 0.45);
}

/// Trunk and two legs.
struct Walker {
  Mannequin mannequin;
  DistanceField field;
  Walker() {
    for (const double y : {0.0, 1.7}) mannequin.mesh.vertices.push_back(Vec3(0, y, 0));
    const Vec3 thigh(0.10, 0.76, 0), knee(0.11, 0.45, 0), ankle(0.12, 0.08, -0.02);
    auto& l = mannequin.landmarks;
    l["waist_right"] = Vec3(0.14, 1.05, 0), l["waist_left"] = Vec3(-0.14, 1.05, 0), l["crotch"] = Vec3(0, 0.79, 0);
    l["thigh_right"] = thigh, l["knee_right"] = knee, l["ankle_right"] = ankle;
    for (const char* name : {"thigh", "knee", "ankle"})
      l[std::string(name) + "_left"] = mirrored(l[std::string(name) + "_right"]);
    field.spacing = 0.01;
    field.origin = Vec3(-0.5, -0.1, -0.4);
    field.size = {101, 161, 81};
    for (int z = 0; z < field.size[2]; ++z)
      for (int y = 0; y < field.size[1]; ++y)
        for (int x = 0; x < field.size[0]; ++x) {
          const Vec3 p = field.origin + field.spacing * Vec3(x, y, z);
          double d = capsule(p, Vec3(0, 0.93, 0), Vec3(0, 1.35, 0), 0.14);
          for (const Vec3& q : {p, mirrored(p)})
            d = std::min({d, capsule(q, Vec3(0.10, 0.90, 0), knee, 0.08), capsule(q, knee, ankle, 0.045)});
          field.values.push_back(static_cast<float>(d));
        }
  }
};

/// Trousers of a rise and legs that lie `degrees` apart from the vertical; nodes on the outline only.
struct Trousers {
  GarmentTemplate garment;
  Pattern pattern;
  std::map<std::string, int> index;
  Trousers(double rise, double degrees) {
    const double a = degrees * M_PI / 180;
    const Vec2 inner = Vec2(0, -rise) + 0.66 * Vec2(std::sin(a), -std::cos(a));
    const Vec2 outer = inner + 0.20 * Vec2(std::cos(a), std::sin(a));
    const std::vector<std::pair<std::string, Vec2>> loop{{"waist_left", {-0.20, 0}},
                                                         {"hem_outer_left", {-outer.x(), outer.y()}},
                                                         {"hem_inner_left", {-inner.x(), inner.y()}},
                                                         {"crotch", {0, -rise}},
                                                         {"hem_inner_right", inner},
                                                         {"hem_outer_right", outer},
                                                         {"waist_right", {0.20, 0}}};
    Panel panel;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto& [name, from] = loop[i];
      const Vec2 to = loop[(i + 1) % loop.size()].second;
      index[name] = static_cast<int>(i);
      const bool crotch = name == "crotch";
      garment.features.push_back(
          {name, "", static_cast<int>(crotch ? i : loop.size() - 1 - i), crotch ? Turn::concave : Turn::convex});
      panel.corner.push_back(static_cast<int>(panel.outline.size()));
      for (int k = 0; k < 20; ++k) panel.outline.push_back(from + (to - from) * k / 20.0);
    }
    for (const char* name : {"waist_left", "waist_right", "crotch"}) {
      garment.features[index[name]].landmark = name;
      garment.anchors.push_back(index[name]);
    }
    for (const std::string side : {"_left", "_right"})
      garment.limbs.push_back({"leg" + side,
                               index["waist" + side],
                               index["crotch"],
                               index["hem_outer" + side],
                               index["hem_inner" + side],
                               {"thigh" + side, "knee" + side, "ankle" + side}});
    for (const Side side : {Side::front, Side::back}) {
      panel.side = side;
      pattern.panels.push_back(panel);
      pattern.meshes.push_back({panel.outline, {}});
    }
  }
  Vec3 at(const Placement& placed, int panel, const std::string& name) const {
    return placed[panel][pattern.panels[panel].corner[index.at(name)]];
  }
};

TEST(Fit, trouser_legs_of_any_spread_wrap_their_own_leg) {
  const Walker walker;
  for (const double degrees : {1.0, 8.0, 20.0}) {
    const Trousers trousers(0.28, degrees);
    const auto placed = place_panels(trousers.garment, trousers.pattern, walker.mannequin, walker.field);
    ASSERT_TRUE(placed);
    for (int panel = 0; panel < 2; ++panel) {
      for (std::size_t i = 0; i < (*placed)[panel].size(); ++i) {
        const Vec3 q = (*placed)[panel][i];
        const double flat = trousers.pattern.meshes[panel].nodes[i].x();
        EXPECT_GE(walker.field.distance(q), 0.009) << degrees;
        EXPECT_TRUE(std::abs(flat) < 1e-6 || q.x() * flat > 0) << "no cloth on the other leg's side, " << degrees;
      }
      for (const std::string side : {"_left", "_right"}) {
        const double leg = std::abs(walker.mannequin.landmarks.at("ankle" + side).x());
        EXPECT_LT(std::abs(trousers.at(*placed, panel, "hem_inner" + side).x()), leg - 0.04) << degrees;
        EXPECT_GT(std::abs(trousers.at(*placed, panel, "hem_outer" + side).x()), leg + 0.04) << degrees;
      }
    }
    for (const char* name : {"hem_inner_left", "hem_outer_left", "hem_inner_right", "hem_outer_right"})
      EXPECT_LT((trousers.at(*placed, 0, name) - trousers.at(*placed, 1, name)).norm(), 0.03)
          << "the leg's seams start closed at the hem";
  }
}

TEST(Fit, trousers_hang_from_the_waist_or_where_the_rise_is_short_from_the_crotch) {
  const Walker walker;
  const double waist = walker.mannequin.landmarks.at("waist_left").y(),
               crotch = walker.mannequin.landmarks.at("crotch").y();
  for (const double rise : {0.18, 0.22, 0.26, 0.32, 0.40}) {
    const Trousers trousers(rise, 4);
    const auto placed = place_panels(trousers.garment, trousers.pattern, walker.mannequin, walker.field);
    ASSERT_TRUE(placed);
    const double at_waist = trousers.at(*placed, 0, "waist_left").y(),
                 at_crotch = trousers.at(*placed, 0, "crotch").y();
    EXPECT_LE(at_crotch, crotch - 0.019) << rise << ": the crotch closes under the body";
    EXPECT_LE(at_waist, waist + 0.021) << rise;
    EXPECT_TRUE(std::abs(at_crotch - crotch + 0.02) < 1e-9 || std::abs(at_waist - waist - 0.02) < 1e-9) << rise;
  }
}

TEST(Fit, a_body_without_voxels_is_refused) {
  const Doll doll;
  const Shirt shirt(30);
  const auto placed = place_panels(shirt.garment, shirt.pattern, doll.mannequin, {});
  ASSERT_FALSE(placed);
  EXPECT_EQ(placed.error().code, "NO_BODY");
}

TEST(Fit, a_panel_of_another_size_than_any_body_is_refused) {
  const Doll doll;
  Shirt shirt(30);
  for (auto& panel : shirt.pattern.panels)
    for (Vec2& p : panel.outline) p *= 100;
  const auto placed = place_panels(shirt.garment, shirt.pattern, doll.mannequin, doll.field);
  ASSERT_FALSE(placed);
  EXPECT_EQ(placed.error().code, "PANEL_SIZE");
}

TEST(Fit, a_missing_landmark_is_named) {
  Doll doll;
  doll.mannequin.landmarks.erase("wrist_left");
  const Shirt shirt(30);
  const auto placed = place_panels(shirt.garment, shirt.pattern, doll.mannequin, doll.field);
  ASSERT_FALSE(placed);
  EXPECT_EQ(placed.error().code, "NO_LANDMARK");
  EXPECT_NE(placed.error().message.find("wrist_left"), std::string::npos);
}
