// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "vitrine/texture.hpp"

namespace vitrine::test {
namespace {

/// A sheet in the plane z = 0, 0.4 m wide and high, its texture one to one; the valley bends both halves forward.
RenderMesh sheet(double bend) {
  RenderMesh m;
  m.name = "garment";
  m.texture = Image(256, 256, 3, 128);
  constexpr int n = 20;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = 0.4 * i / n - 0.2;
      m.positions.emplace_back(x * std::cos(bend), 1.0 + 0.4 * j / n, std::abs(x) * std::sin(bend));
      m.normals.push_back(Vec3((x > 0 ? -1 : x < 0 ? 1 : 0) * std::sin(bend), 0, std::cos(bend)).normalized());
      m.uv.emplace_back(0.05 + 0.9 * i / n, 0.95 - 0.9 * j / n);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (n + 1) + i);
      m.triangles.push_back({a, a + 1, a + n + 2});
      m.triangles.push_back({a, a + n + 2, a + n + 1});
    }
  return m;
}

/// A body far from the sheet.
RenderMesh far_body() {
  RenderMesh b;
  b.name = "mannequin";
  b.positions = {Vec3(50, 0, 0), Vec3(51, 0, 0), Vec3(50, 1, 0)};
  b.normals.assign(3, Vec3::UnitZ());
  b.triangles = {{0, 1, 2}};
  return b;
}

TEST(Occlusion, leaves_a_flat_sheet_alone_as_open_all_over) {
  RenderMesh cloth = sheet(0), body = far_body();
  ASSERT_EQ(bake_occlusion(cloth, body, {.texel = 0.008}), std::nullopt);
  EXPECT_EQ(cloth.occlusion.width, 64);
  EXPECT_EQ(cloth.occlusion.channels, 1);
  for (const std::uint8_t v : cloth.occlusion.data) EXPECT_EQ(v, 255);
  for (const float v : body.shade) EXPECT_EQ(v, 1.0F);
}

TEST(Occlusion, darkens_the_bottom_of_a_fold_and_less_the_further_from_it) {
  RenderMesh cloth = sheet(0.9), body = far_body();
  ASSERT_EQ(bake_occlusion(cloth, body, {.texel = 0.008, .rays = 64}), std::nullopt);
  const auto mean = [&](int from, int to) {
    double sum = 0;
    for (int y = 16; y < 48; ++y)
      for (int x = from; x < to; ++x) sum += *cloth.occlusion.at(x, y);
    return sum / (32.0 * (to - from));
  };
  const double bottom = mean(31, 33), slope = mean(20, 22), edge = mean(5, 7);
  EXPECT_LT(bottom, slope - 15);
  EXPECT_LT(slope, edge - 15);
  // A wedge of half angle a about the normal is sin(a) of the sky, weighted with the cosine; here a = pi / 2 - 0.9.
  EXPECT_NEAR(bottom / 255.0, std::cos(0.9), 0.05);
}

TEST(Occlusion, shades_the_body_under_the_cloth) {
  RenderMesh cloth = sheet(0), body = far_body();
  for (Vec3& p : body.positions) p = Vec3(0.02 * (p.x() - 50), 1.2 + 0.02 * p.y(), -0.02);
  ASSERT_EQ(bake_occlusion(cloth, body), std::nullopt);
  for (const float v : body.shade) EXPECT_LT(v, 0.35F);
}

TEST(Occlusion, is_the_same_bytes_twice_and_refuses_impossible_options) {
  RenderMesh a = sheet(0.7), b = sheet(0.7), body = far_body();
  ASSERT_EQ(bake_occlusion(a, body), std::nullopt);
  ASSERT_EQ(bake_occlusion(b, body), std::nullopt);
  EXPECT_EQ(a.occlusion.data, b.occlusion.data);
  const auto error = bake_occlusion(a, body, {.rays = 0});
  ASSERT_TRUE(error);
  EXPECT_EQ(error->exit_code(), 64);
}

}  // namespace
}  // namespace vitrine::test
