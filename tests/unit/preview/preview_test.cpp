// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/preview.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace vitrine::test {
namespace {

constexpr std::array<int, 3> kFront{190, 45, 40}, kBack{40, 60, 180}, kMark{240, 230, 60};

/// A closed tube about the y axis, from 0.6 m to 1.2 m. The left half of the atlas is the front, the right half the
/// back, each with a yellow mark on the left of the front frame (x < 0).
RenderMesh tube(double radius = 0.2) {
  RenderMesh m;
  m.name = "garment";
  m.texture = Image(128, 64, 3);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 128; ++x) {
      const bool mark = x % 64 >= 8 && x % 64 < 26 && y >= 20 && y < 44;
      const auto& colour = mark ? kMark : x < 64 ? kFront : kBack;
      for (int c = 0; c < 3; ++c) m.texture.at(x, y)[c] = static_cast<std::uint8_t>(colour[c]);
    }
  constexpr int n = 32, rows = 12;
  for (int side = 0; side < 2; ++side) {
    const auto base = static_cast<std::uint32_t>(m.positions.size());
    for (int j = 0; j <= rows; ++j)
      for (int i = 0; i <= n; ++i) {
        const double a = std::numbers::pi * (1.0 * i / n - 0.5);
        const Vec3 out(std::sin(a), 0, side ? -std::cos(a) : std::cos(a));
        m.positions.emplace_back(radius * out + Vec3(0, 0.6 + 0.6 * j / rows, 0));
        m.normals.push_back(out);
        m.uv.emplace_back(0.5 * side + (1.0 + 62.0 * i / n) / 128.0, 1.0 - 1.0 * j / rows);
      }
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < n; ++i) {
        const std::uint32_t a = base + j * (n + 1) + i, b = a + 1, d = a + n + 1, c = d + 1;
        if (side) {
          m.triangles.push_back({a, c, b});
          m.triangles.push_back({a, d, c});
        } else {
          m.triangles.push_back({a, b, c});
          m.triangles.push_back({a, c, d});
        }
      }
  }
  return m;
}

const PreviewOptions kSmall{.view_width = 120, .view_height = 180, .samples = 2, .occlusion_rays = 4};

Image render(const std::vector<RenderMesh>& meshes, const PreviewOptions& options = kSmall) {
  auto picture = render_preview(meshes, options);
  EXPECT_TRUE(picture) << (picture ? "" : picture.error().message);
  return picture ? *std::move(picture) : Image(options.view_width * 3, options.view_height, 3);
}

/// Which of the scene's colours a pixel shows; hue, not brightness, decides.
enum class Seen { ground, front, back, mark };
Seen seen(const std::uint8_t* p) {
  const int r = p[0], g = p[1], b = p[2];
  if (r > 2 * g && r > 2 * b) return Seen::front;
  if (b > 2 * r && b > 3 * g / 2) return Seen::back;
  if (r > 2 * b && g > 2 * b) return Seen::mark;
  return Seen::ground;
}

struct Count {
  int pixels = 0;
  double mean_x = 0;  // within its view
};
Count count(const Image& picture, int view, Seen what) {
  Count c;
  const int width = picture.width / 3;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < width; ++x)
      if (seen(picture.at(view * width + x, y)) == what) {
        ++c.pixels;
        c.mean_x += x;
      }
  if (c.pixels) c.mean_x /= c.pixels;
  return c;
}

TEST(Preview, shows_front_three_quarter_and_back_side_by_side) {
  const Image picture = render({tube()});
  EXPECT_EQ(picture.width, 360);
  EXPECT_EQ(picture.height, 180);
  EXPECT_EQ(picture.channels, 3);
  EXPECT_GT(count(picture, 0, Seen::front).pixels, 1000);
  EXPECT_EQ(count(picture, 0, Seen::back).pixels, 0);
  EXPECT_GT(count(picture, 1, Seen::front).pixels, 800);
  EXPECT_GT(count(picture, 1, Seen::back).pixels, 50);
  EXPECT_GT(count(picture, 2, Seen::back).pixels, 1000);
  EXPECT_EQ(count(picture, 2, Seen::front).pixels, 0);
}

TEST(Preview, is_not_mirrored) {
  const Image picture = render({tube()});
  const Count front = count(picture, 0, Seen::mark), back = count(picture, 2, Seen::mark);
  ASSERT_GT(front.pixels, 50);
  ASSERT_GT(back.pixels, 50);
  EXPECT_LT(front.mean_x, 54);  // x < 0 is the left of the front view
  EXPECT_GT(back.mean_x, 66);   // and seen from behind it is the right
}

TEST(Preview, shows_a_surface_that_faces_the_camera_in_its_own_colour) {
  const Image picture =
      render({tube(0.4)}, {.view_width = 120, .view_height = 180, .samples = 8, .occlusion_rays = 16});
  // The middle of the front, away from the mark.
  const auto linear = [](double v) { return std::pow(v / 255.0, 2.2); };
  std::array<double, 3> mean{};
  for (int y = 70; y < 110; ++y)
    for (int x = 58; x < 66; ++x)
      for (int c = 0; c < 3; ++c) mean[c] += linear(picture.at(x, y)[c]) / 320.0;
  EXPECT_NEAR(mean[0] / linear(kFront[0]), 1.0, 0.10);
}

TEST(Preview, is_the_same_bytes_twice) {
  EXPECT_EQ(render({tube()}).data, render({tube()}).data);
}

TEST(Preview, stands_before_a_clean_backdrop) {
  const Image picture = render({tube()});
  const std::uint8_t* corner = picture.at(0, 0);
  EXPECT_GT(corner[0], 200);
  for (int x = 0; x < picture.width; ++x)
    for (int y : {0, 1})
      for (int c = 0; c < 3; ++c) ASSERT_EQ(picture.at(x, y)[c], corner[0]);
  for (int y = 0; y < picture.height; ++y)
    for (int c = 0; c < 3; ++c) ASSERT_EQ(picture.at(0, y)[c], corner[0]);
}

TEST(Preview, keeps_the_whole_subject_in_the_frame) {
  RenderMesh wide = tube(0.7);
  const Image picture = render({wide});
  for (int view = 0; view < 3; ++view)
    for (int y = 0; y < picture.height; ++y)
      for (int x : {0, 119}) EXPECT_EQ(seen(picture.at(120 * view + x, y)), Seen::ground);
  EXPECT_GT(count(picture, 0, Seen::front).pixels, 3000);
}

TEST(Preview, shows_the_frame_it_is_asked_for) {
  PreviewOptions close = kSmall;
  close.frame_bottom = 0.8;
  close.frame_top = 1.0;
  // Within the tube's height nothing but tube is seen in the middle column.
  const Image picture = render({tube()}, close);
  for (int y = 0; y < picture.height; ++y) EXPECT_NE(seen(picture.at(75, y)), Seen::ground) << y;
}

TEST(Preview, shows_the_inner_side_darker_than_the_outer) {
  // One sheet, seen from its outer face in the front view and from its inner face in the back view.
  RenderMesh sheet;
  sheet.name = "garment";
  sheet.colour = {0.5, 0.1, 0.1};
  for (const Vec2& p : {Vec2(-0.3, 0.5), Vec2(0.3, 0.5), Vec2(0.3, 1.3), Vec2(-0.3, 1.3)}) {
    sheet.positions.emplace_back(p.x(), p.y(), 0);
    sheet.normals.emplace_back(0, 0, 1);
  }
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Image picture = render({sheet});
  const int outer = picture.at(60, 90)[0], inner = picture.at(240 + 60, 90)[0];
  EXPECT_LT(inner, outer - 10);
  EXPECT_GT(inner, outer / 2);
}

TEST(Preview, the_inner_side_keeps_its_colour_where_hardly_any_sky_is_seen) {
  // A sheet's inner face at the bottom of a slot 30 cm deep and 4 cm wide, looked into from behind.
  RenderMesh sheet, walls;
  sheet.name = "garment";
  sheet.colour = {0.5, 0.1, 0.1};
  walls.name = "walls";
  walls.colour = {0.02, 0.02, 0.02};
  const auto quad = [](RenderMesh& m, const std::array<Vec3, 4>& corners, const Vec3& normal) {
    const auto base = static_cast<std::uint32_t>(m.positions.size());
    m.positions.insert(m.positions.end(), corners.begin(), corners.end());
    m.normals.insert(m.normals.end(), 4, normal);
    m.triangles.push_back({base, base + 1, base + 2});
    m.triangles.push_back({base, base + 2, base + 3});
  };
  quad(sheet, {Vec3(-0.3, 0.5, 0), Vec3(0.3, 0.5, 0), Vec3(0.3, 1.3, 0), Vec3(-0.3, 1.3, 0)}, {0, 0, 1});
  for (const double x : {-0.02, 0.02})
    quad(walls, {Vec3(x, 0.5, 0), Vec3(x, 0.5, -0.3), Vec3(x, 1.3, -0.3), Vec3(x, 1.3, 0)}, {x > 0 ? -1.0 : 1.0, 0, 0});
  PreviewOptions options = kSmall;
  options.occlusion_rays = 32;
  const Image picture = render({sheet, walls}, options);
  const std::uint8_t* inner = picture.at(240 + 60, 90);
  EXPECT_GT(inner[0], 88);  // 72 by rays alone
  EXPECT_GT(inner[0], 3 * inner[1] / 2);
}

TEST(Preview, grounds_a_standing_body_with_a_contact_shadow) {
  RenderMesh body = tube(0.12);
  for (Vec3& p : body.positions) p.y() -= 0.6;
  const Image picture = render({body});
  const int empty = picture.at(0, 0)[0];
  int darkest = 255;
  for (int x = 0; x < 120; ++x)
    for (int y = 0; y < picture.height; ++y)
      if (seen(picture.at(x, y)) == Seen::ground) darkest = std::min<int>(darkest, picture.at(x, y)[0]);
  EXPECT_LT(darkest, empty - 15);
}

TEST(Preview, is_clear_around_the_subject_without_a_ground_and_solid_on_it) {
  PreviewOptions o = kSmall;
  o.ground = Ground::alpha;
  const Image picture = render({tube()}, o);
  ASSERT_EQ(picture.channels, 4);
  EXPECT_EQ(picture.at(0, 0)[3], 0);
  EXPECT_EQ(picture.at(60, 90)[3], 255);
  EXPECT_EQ(seen(picture.at(60, 90)), Seen::front);
  // Along the subject's edge the colour is the subject's own: no ground is mixed into it.
  for (int y = 40; y < 140; ++y)
    for (int x = 0; x < 120; ++x)
      if (const std::uint8_t* p = picture.at(x, y); p[3] > 60 && p[3] < 255) {
        EXPECT_NE(seen(p), Seen::ground) << x << "," << y;
      }
}

TEST(Preview, keeps_the_camera_still_whatever_the_body_wears) {
  PreviewOptions o = kSmall;
  o.subject = SubjectBox{Vec3(-0.5, 0, -0.2), Vec3(0.5, 1.7, 0.2)};
  const RenderMesh body = tube(0.12);
  RenderMesh wide = tube(0.45);
  for (Vec3& p : wide.positions) p.y() -= 0.5;  // from 0.1 m to 0.7 m
  const auto rows_of_the_top = [&](const PreviewOptions& options, const std::vector<RenderMesh>& meshes) {
    const Image picture = render(meshes, options);
    std::vector<int> widths;
    for (int y = 0; y < 80; ++y) {
      int n = 0;
      for (int x = 0; x < 120; ++x) n += seen(picture.at(x, y)) != Seen::ground;
      widths.push_back(n);
    }
    return widths;
  };
  const auto bare = rows_of_the_top(o, {body});
  EXPECT_GT(*std::max_element(bare.begin(), bare.end()), 8);
  EXPECT_EQ(bare, rows_of_the_top(o, {body, wide}));
  EXPECT_NE(rows_of_the_top(kSmall, {body}), rows_of_the_top(kSmall, {body, wide}));
}

TEST(Preview, turns_the_subject_once_round_on_a_turntable) {
  const auto turns = turntable(8);
  ASSERT_EQ(turns.size(), 8u);
  PreviewOptions o = kSmall;
  o.turns_deg = turns;
  auto strip = render_preview(std::vector<RenderMesh>{tube()}, o);
  ASSERT_TRUE(strip);
  EXPECT_EQ(strip->width, 8 * 120);
  const auto shown = [&](int view, Seen what) {
    int n = 0;
    for (int y = 0; y < 180; ++y)
      for (int x = 0; x < 120; ++x) n += seen(strip->at(view * 120 + x, y)) == what;
    return n;
  };
  EXPECT_EQ(shown(0, Seen::back), 0);
  EXPECT_EQ(shown(4, Seen::front), 0);
  EXPECT_GT(shown(4, Seen::back), 1000);
  EXPECT_GT(shown(2, Seen::back), 300);
  EXPECT_GT(shown(6, Seen::back), 300);
}

TEST(Preview, shows_folds_by_light_and_shade_in_one_plain_colour) {
  // A sheet with vertical folds 6 cm apart and 2 cm deep, of one colour.
  RenderMesh sheet;
  sheet.name = "garment";
  sheet.colour = {0.4, 0.4, 0.4};
  constexpr int n = 120;
  for (int j = 0; j <= 2; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = 0.6 * i / n - 0.3, a = 2 * std::numbers::pi * x / 0.06;
      sheet.positions.emplace_back(x, 0.5 + 0.4 * j, 0.01 * std::cos(a));
      sheet.normals.push_back(Vec3(0.01 * 2 * std::numbers::pi / 0.06 * std::sin(a), 0, 1).normalized());
    }
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < n; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (n + 1) + i);
      sheet.triangles.push_back({a, a + 1, a + n + 2});
      sheet.triangles.push_back({a, a + n + 2, a + n + 1});
    }
  PreviewOptions o{.turns_deg = {0}, .view_width = 300, .view_height = 300, .samples = 4, .occlusion_rays = 12};
  const Image picture = render({sheet}, o);
  int low = 255, high = 0;
  for (int x = 110; x < 190; ++x) {
    low = std::min<int>(low, picture.at(x, 150)[1]);
    high = std::max<int>(high, picture.at(x, 150)[1]);
  }
  EXPECT_GT(high - low, 40);
}

TEST(Preview, a_bare_surface_looks_like_one_with_a_texture_of_its_colour) {
  // Fewer rays are shot at it, which must not show: neither on it nor where a limb stands before it.
  RenderMesh limb = tube(0.06);
  for (Vec3& p : limb.positions) p += Vec3(0.1, 0, 0.4);
  std::vector<RenderMesh> bare{tube(), limb}, painted = bare;
  for (RenderMesh& m : painted) std::fill(m.texture.data.begin(), m.texture.data.end(), std::uint8_t{128});
  for (RenderMesh& m : bare) {
    m.texture = {};
    m.uv.clear();
    m.colour = {0.2159, 0.2159, 0.2159};  // linear light of 128
  }
  PreviewOptions o = kSmall;
  o.samples = 4;
  const Image one = render(bare, o), many = render(painted, o);
  int most = 0;
  for (std::size_t i = 0; i < one.data.size(); ++i) most = std::max(most, std::abs(one.data[i] - many.data[i]));
  EXPECT_LE(most, 6);
}

TEST(Preview, refuses_what_it_cannot_draw) {
  const auto refused = [](RenderMesh m, PreviewOptions o = kSmall) {
    const auto picture = render_preview(std::span(&m, 1), o);
    return picture ? 0 : picture.error().exit_code();
  };
  EXPECT_FALSE(render_preview({}, kSmall));
  RenderMesh m = tube();
  m.positions[3].z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused(m), 70);
  m = tube();
  m.triangles[3][1] = 1'000'000;
  EXPECT_EQ(refused(m), 70);
  m = tube();
  m.texture.data.pop_back();
  EXPECT_EQ(refused(m), 70);
  m = tube();
  m.normals.clear();
  EXPECT_EQ(refused(m), 70);
  EXPECT_EQ(refused(tube(), {.view_width = 1 << 30}), 64);
  EXPECT_EQ(refused(tube(), {.frame_bottom = 1.0, .frame_top = 0.5}), 64);
}

}  // namespace
}  // namespace vitrine::test
