// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/fidelity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace vitrine {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double scale = 400;  // [px/m] of the photo

/// A garment on the table: its panel meshed by triangles, its photo, and the same cloth flat in space.
struct Scene {
  GarmentTemplate garment;
  Image labels{400, 400, 1};
  Pattern pattern;
  std::vector<std::vector<Vec3>> positions;
};

/// The outline is counter-clockwise in panel metres, every node a feature.
Scene lay_flat(const std::vector<Vec2>& outline, const std::vector<Triangle>& triangles) {
  Scene scene;
  Panel panel;
  panel.outline = outline;
  panel.pixel_from_panel = {Vec2(200, 200), Vec2(scale, 0), Vec2(0, -scale)};
  PanelMesh mesh;
  mesh.nodes = outline;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    scene.garment.features.push_back({"corner_" + std::to_string(i), "", -1, Turn::any});
    panel.corner.push_back(static_cast<int>(i));
  }
  mesh.triangles = triangles;
  const Affine2 to_panel = panel.pixel_from_panel.inverse();
  for (int y = 0; y < scene.labels.height; ++y)
    for (int x = 0; x < scene.labels.width; ++x) {
      const Vec2 p = to_panel(Vec2(x, y));
      bool inside = false;
      for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++)
        if ((outline[i].y() > p.y()) != (outline[j].y() > p.y()) &&
            p.x() < (outline[j].x() - outline[i].x()) * (p.y() - outline[i].y()) / (outline[j].y() - outline[i].y()) +
                        outline[i].x())
          inside = !inside;
      if (inside) *scene.labels.at(x, y) = label_outside;
    }
  for (int k = 0; k < 2; ++k) {
    scene.pattern.panels.push_back(panel);
    scene.pattern.meshes.push_back(mesh);
    scene.positions.emplace_back();
    for (const Vec2& p : mesh.nodes) scene.positions.back().emplace_back(p.x(), p.y(), k == 0 ? 0.1 : -0.1);
  }
  return scene;
}

Scene flared() {
  return lay_flat({{-0.30, -0.40}, {0.30, -0.40}, {0.26, -0.08}, {0.20, 0.40}, {-0.20, 0.40}, {-0.26, -0.08}},
                  {{0, 1, 2}, {0, 2, 5}, {5, 2, 3}, {5, 3, 4}});
}

/// A trunk with two sleeves that stand off to the sides; the cloth's edges follow their root lines.
Scene with_sleeves() {
  Scene scene = lay_flat({{-0.20, -0.40},
                          {0.20, -0.40},
                          {0.20, 0.10},
                          {0.45, -0.05},
                          {0.48, 0.05},
                          {0.20, 0.30},
                          {-0.20, 0.30},
                          {-0.48, 0.05},
                          {-0.45, -0.05},
                          {-0.20, 0.10}},
                         {{0, 1, 2}, {0, 2, 9}, {9, 2, 5}, {9, 5, 6}, {2, 3, 4}, {2, 4, 5}, {9, 7, 8}, {9, 6, 7}});
  scene.garment.limbs = {{"sleeve_right", 5, 2, 4, 3, {}}, {"sleeve_left", 6, 9, 7, 8, {}}};
  return scene;
}

Fidelity compare(const Scene& scene) {
  auto found = compare_with_photo(scene.labels, scene.garment, scene.pattern, scene.positions);
  EXPECT_TRUE(found) << found.error().message;
  return found ? *found : Fidelity{};
}

void move(Scene& scene, const std::function<Vec3(const Vec3&)>& to) {
  for (auto& panel : scene.positions)
    for (Vec3& p : panel) p = to(p);
}

TEST(Fidelity, cloth_that_lies_as_in_the_photo_looks_like_it) {
  const Fidelity f = compare(flared());
  EXPECT_GT(f.iou, 0.985);
  EXPECT_GT(f.iou_true_size, 0.985);
  EXPECT_LT(f.landmark_max_mm, 5);
  EXPECT_THAT(f.left_out, IsEmpty());
}

TEST(Fidelity, does_not_care_where_the_mannequin_stands_nor_how_deep_the_cloth_lies) {
  Scene scene = flared();
  move(scene, [](const Vec3& p) { return Vec3(p.x() + 0.4, p.y() + 1.3, p.z() + std::sin(9 * p.x())); });
  const Fidelity f = compare(scene);
  EXPECT_GT(f.iou_true_size, 0.985);
  EXPECT_NEAR(f.fit.shift.x(), 0.4, 0.004);
  EXPECT_NEAR(f.fit.shift.y(), 1.3, 0.004);
}

TEST(Fidelity, cloth_around_a_body_shows_less_width_which_one_scale_cannot_take_up_and_two_can) {
  Scene scene = flared();
  move(scene, [](const Vec3& p) { return Vec3(0.7 * p.x(), p.y() + 1, p.z()); });
  const Fidelity f = compare(scene);
  EXPECT_GT(f.iou, 0.985);
  EXPECT_NEAR(f.fit.width, 0.7, 0.01);
  EXPECT_NEAR(f.fit.height, 1.0, 0.01);
  EXPECT_LT(f.iou_uniform, 0.9);
  EXPECT_LT(f.iou_true_size, f.iou_uniform);
}

TEST(Fidelity, a_camera_held_askew_is_told_from_a_garment_that_hangs_askew_by_six_degrees_at_most) {
  const auto worn_at = [](double degrees) {
    Scene scene = flared();
    const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
    move(scene, [&](const Vec3& p) { return Vec3(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z()); });
    return compare(scene);
  };
  for (const double degrees : {-4.0, 3.0}) {
    const Fidelity f = worn_at(degrees);
    EXPECT_GT(f.iou_posed, 0.98) << degrees;
    EXPECT_LT(f.iou, 0.97) << degrees;
    EXPECT_NEAR(f.camera_turn * 180 / M_PI, degrees, 0.5);
  }
  const Fidelity f = worn_at(20);
  EXPECT_LT(f.iou_posed, 0.93);
  EXPECT_LE(std::abs(f.camera_turn) * 180 / M_PI, 6.001);
}

TEST(Fidelity, another_shape_is_seen_whatever_is_fitted) {
  Scene scene = flared();
  move(scene, [](const Vec3& p) { return Vec3(p.x() * (p.y() < 0 ? 0.5 : 1.0), p.y(), p.z()); });  // a flare lost
  const Fidelity f = compare(scene);
  EXPECT_LT(f.iou, 0.85);
  EXPECT_LT(f.iou_posed, 0.85);
  EXPECT_GT(f.landmark_max_mm, 30);
}

TEST(Fidelity, sleeves_are_left_out_however_the_arms_hang) {
  Scene scene = with_sleeves();
  move(scene, [](const Vec3& p) {
    const double beyond = std::max(0.0, std::abs(p.x()) - 0.2);
    return Vec3(p.x() - std::copysign(0.7 * beyond, p.x()), p.y() - 1.2 * beyond, p.z());
  });
  const Fidelity f = compare(scene);
  EXPECT_GT(f.iou, 0.985);
  EXPECT_THAT(f.left_out, ElementsAre("sleeve_right", "sleeve_left"));
  EXPECT_EQ(f.landmarks.size(), 6u) << "points beyond the root line are no landmarks of the trunk";
}

TEST(Fidelity, limbs_that_share_a_root_are_the_garment_and_stay) {
  Scene scene = with_sleeves();
  scene.garment.limbs[1].root_b = scene.garment.limbs[0].root_b;
  EXPECT_THAT(compare(scene).left_out, IsEmpty());
}

TEST(Fidelity, legs_are_posed_as_the_mannequin_stands_and_no_more) {
  // Two straight legs below a waist that is cut at the sides of the crotch.
  Scene scene =
      lay_flat({{-0.30, -0.40}, {-0.10, -0.40}, {0, 0.05}, {0.10, -0.40}, {0.30, -0.40}, {0.20, 0.40}, {-0.20, 0.40}},
               {{0, 1, 2}, {0, 2, 6}, {6, 2, 5}, {2, 4, 5}, {2, 3, 4}});
  scene.garment.limbs = {{"leg_left", 6, 2, 0, 1, {}}, {"leg_right", 5, 2, 4, 3, {}}};
  const auto closer = [](const Vec3& p) {
    const double by = 0.15 * std::max(0.0, 0.05 - p.y());
    return Vec3(p.x() - std::copysign(by, p.x()), p.y(), p.z());
  };
  move(scene, closer);
  const Fidelity f = compare(scene);
  EXPECT_LT(f.iou, 0.93);
  EXPECT_GT(f.iou_posed, 0.96);
  EXPECT_NEAR(f.leg_swing, -0.15, 0.03);
  move(scene, [](const Vec3& p) { return Vec3(p.x(), p.x() > 0 && p.y() < 0 ? p.y() + 0.2 : p.y(), p.z()); });
  EXPECT_LT(compare(scene).iou_posed, 0.93) << "one leg is shorter";
}

TEST(Fidelity, says_by_how_much_a_single_point_is_off) {
  Scene scene = flared();
  scene.positions[0][3].y() -= 0.03;  // one corner of the front alone; the back keeps the silhouette
  const Fidelity f = compare(scene);
  EXPECT_NEAR(f.landmarks[3].miss_mm, 30, 5);
  EXPECT_LT(f.landmarks[0].miss_mm, 8);
}

TEST(Fidelity, same_input_same_bytes) {
  const Scene scene = with_sleeves();
  const Image a = draw_fidelity(compare(scene)), b = draw_fidelity(compare(scene));
  EXPECT_EQ(a.data, b.data);
  EXPECT_FALSE(a.empty());
}

TEST(Fidelity, refuses_what_it_cannot_compare) {
  const Scene scene = flared();
  const auto code = [](const auto& result) { return result ? std::string("OK") : result.error().code; };
  EXPECT_EQ(code(compare_with_photo({}, scene.garment, scene.pattern, scene.positions)), "NOTHING_TO_COMPARE");
  EXPECT_EQ(code(compare_with_photo(Image(400, 400, 1), scene.garment, scene.pattern, scene.positions)),
            "NOTHING_TO_COMPARE");
  EXPECT_EQ(code(compare_with_photo(scene.labels, scene.garment, scene.pattern, {})), "NOTHING_TO_COMPARE");
  Scene broken = scene;
  broken.positions[1][0].x() = NAN;
  EXPECT_EQ(code(compare_with_photo(broken.labels, broken.garment, broken.pattern, broken.positions)),
            "NOTHING_TO_COMPARE");
  EXPECT_EQ(code(compare_with_photo(scene.labels, scene.garment, scene.pattern, scene.positions, {.rows = 8})),
            "BAD_FIDELITY_OPTION");
}

}  // namespace
}  // namespace vitrine
