// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "scene.hpp"

namespace vitrine::test {
namespace {

Atlas make(const std::vector<const Shot*>& shots, const TextureOptions& options = {}) {
  std::vector<TextureSource> sources;
  for (const Shot* shot : shots) sources.push_back(shot->source());
  auto atlas = make_atlas(sources, options);
  EXPECT_TRUE(atlas) << (atlas ? "" : atlas.error().message);
  return atlas ? *std::move(atlas) : Atlas{};
}

/// Atlas pixel that shows photo pixel (x, y) of an unscaled panel; the back's picture is turned round.
std::array<int, 2> place(const Atlas& atlas, std::size_t panel, const Shot& shot, int x, int y) {
  const Vec2 node = shot.panel.pixel_from_panel(shot.mesh.nodes[0]);
  const Vec2 at = atlas.uv[panel][0].cwiseProduct(Vec2(atlas.rgb.width, atlas.rgb.height));
  const double across = shot.panel.side == Side::back ? node.x() - x : x - node.x();
  return {static_cast<int>(std::floor(at.x() + across)), static_cast<int>(std::floor(at.y() + y - node.y()))};
}

int off(const std::uint8_t* a, const Rgb& b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

struct Box {
  Vec2 low = Vec2::Constant(1e9), high = Vec2::Constant(-1e9);
};
Box box_of(const Atlas& atlas, std::size_t panel) {
  Box b;
  for (const Vec2& t : atlas.uv[panel]) {
    const Vec2 p = t.cwiseProduct(Vec2(atlas.rgb.width, atlas.rgb.height));
    b.low = b.low.cwiseMin(p);
    b.high = b.high.cwiseMax(p);
  }
  return b;
}

TEST(Atlas, keeps_the_panels_own_pixels_as_they_are) {
  const Shot front = shoot(Side::front, 800, striped), back = shoot(Side::back, 800, striped);
  const Atlas atlas = make({&front, &back});
  std::size_t panel = 0;
  for (const Shot* shot : {&front, &back}) {
    int changed = 0, seen = 0;
    for (int y = 0; y < shot->rgb.height; ++y)
      for (int x = 0; x < shot->rgb.width; ++x) {
        // A colour in the border's row alone cannot be told from board.
        if (!shot->own(x, y) || !shot->own(x, y - 1)) continue;
        const auto [ax, ay] = place(atlas, panel, *shot, x, y);
        const std::uint8_t* p = shot->rgb.at(x, y);
        changed += off(atlas.rgb.at(ax, ay), {p[0], p[1], p[2]}) > 0;
        ++seen;
      }
    EXPECT_GT(seen, 100'000);
    EXPECT_EQ(changed, 0);
    ++panel;
  }
}

TEST(Atlas, shows_no_board_anywhere_even_where_the_lens_mixed_it_in) {
  const Shot front = shoot(Side::front, 700, plain, true), back = shoot(Side::back, 500, plain, true);
  const Atlas atlas = make({&front, &back});
  int worst = 0;
  for (int y = 0; y < atlas.rgb.height; ++y)
    for (int x = 0; x < atlas.rgb.width; ++x) worst = std::max(worst, off(atlas.rgb.at(x, y), plain({})));
  EXPECT_LE(worst, 16);
}

TEST(Atlas, never_shows_the_inside_of_the_back) {
  Shot front = shoot(Side::front, 600, plain);
  for (int y = 20; y < 90; ++y)
    for (int x = 90; x < 180; ++x) {
      *front.labels.at(x, y) = label_inside;
      std::fill_n(front.rgb.at(x, y), 3, std::uint8_t{250});
    }
  const Atlas atlas = make({&front});
  for (int y = 0; y < atlas.rgb.height; ++y)
    for (int x = 0; x < atlas.rgb.width; ++x) ASSERT_LE(off(atlas.rgb.at(x, y), plain({})), 4) << x << "," << y;
}

TEST(Atlas, keeps_the_colour_of_straps_thinner_than_the_rim) {
  Shot front = shoot(Side::front, 600, plain);
  // Only a strap of 3 px and the lower half remain.
  for (int y = 0; y < 150; ++y)
    for (int x = 0; x < front.rgb.width; ++x) {
      const bool strap = x >= 100 && x < 103 && y >= 21;
      *front.labels.at(x, y) = strap ? label_outside : label_background;
      const Rgb c = strap ? Rgb{20, 30, 160} : kBoard;
      for (int k = 0; k < 3; ++k) front.rgb.at(x, y)[k] = static_cast<std::uint8_t>(c[k]);
    }
  const Atlas atlas = make({&front});
  const auto [x, y] = place(atlas, 0, front, 101, 60);
  for (int dx = -3; dx <= 3; ++dx) EXPECT_LE(off(atlas.rgb.at(x + dx, y), {20, 30, 160}), 6) << dx;
}

TEST(Atlas, is_a_power_of_two_and_its_panels_lie_apart_within_it) {
  for (const double density : {300.0, 620.0, 1100.0, 2900.0}) {
    const Shot front = shoot(Side::front, density, plain), back = shoot(Side::back, 0.8 * density, plain);
    const Atlas atlas = make({&front, &back});
    const auto w = static_cast<unsigned>(atlas.rgb.width), h = static_cast<unsigned>(atlas.rgb.height);
    EXPECT_TRUE(std::has_single_bit(w) && std::has_single_bit(h));
    EXPECT_TRUE(w == h || w == 2 * h);
    EXPECT_GE(h, 512u);
    EXPECT_LE(w, 2048u);
    const Box a = box_of(atlas, 0), b = box_of(atlas, 1);
    const double gutter = 8.0 * w / 1024.0;
    EXPECT_LE(a.high.x() + gutter, b.low.x());
    for (const Box& box : {a, b}) {
      EXPECT_GE(box.low.minCoeff(), gutter);
      EXPECT_LE(box.high.x() + gutter, w);
      EXPECT_LE(box.high.y() + gutter, h);
    }
  }
}

TEST(Atlas, puts_the_front_on_the_left_whatever_the_order) {
  const Shot front = shoot(Side::front, 500, plain), back = shoot(Side::back, 500, striped);
  const Atlas atlas = make({&back, &front});
  EXPECT_LT(box_of(atlas, 1).high.x(), box_of(atlas, 0).low.x());
  EXPECT_EQ(atlas.rgb.data, make({&front, &back}).rgb.data);
}

TEST(Atlas, reduces_photos_that_are_too_large_to_one_common_scale) {
  const Shot front = shoot(Side::front, 3000, plain), back = shoot(Side::back, 2400, plain);
  const Atlas atlas = make({&front, &back}, {.max_size = 1024});
  EXPECT_EQ(atlas.rgb.width, 1024);
  const double a = box_of(atlas, 0).high.x() - box_of(atlas, 0).low.x();
  const double b = box_of(atlas, 1).high.x() - box_of(atlas, 1).low.x();
  EXPECT_NEAR(a / b, 1.0, 0.01);
  EXPECT_GT(a + b, 900);
}

TEST(Atlas, eases_white_below_the_top_value_without_flattening_it) {
  const Shot front = shoot(Side::front, 600, [](const Vec2& p) {
    return Rgb{55 + static_cast<int>(400 * p.y()), 250, 255};
  });
  const Atlas atlas = make({&front}, {.top_value = 240});
  for (const std::uint8_t v : atlas.rgb.data) ASSERT_LE(v, 240);
  const Shot grey = shoot(Side::front, 600, [](const Vec2& p) {
    const int v = 195 + static_cast<int>(120 * p.y());
    return Rgb{v, v, v};
  });
  const Atlas ramp = make({&grey}, {.top_value = 240});
  int steps = 0, last = -1;
  for (int y = grey.rgb.height - 21; y >= 20; --y) {
    const auto [ax, ay] = place(ramp, 0, grey, 100, y);
    const int v = ramp.rgb.at(ax, ay)[0];
    EXPECT_GE(v, last);
    steps += v != last;
    last = v;
  }
  EXPECT_GT(steps, 25);  // 60 grey levels in, at least these still told apart
}

TEST(Atlas, evens_out_a_back_lit_a_little_darker) {
  const Shot front = shoot(Side::front, 500, striped);
  const Shot back = shoot(Side::back, 500, [](const Vec2& p) {
    Rgb c = striped(p);
    for (int& v : c) v = static_cast<int>(std::lround(v * std::pow(0.85, 1 / 2.2)));  // 15 % less light
    return c;
  });
  const Atlas atlas = make({&front, &back});
  for (int y : {60, 120, 200}) {
    const auto [fx, fy] = place(atlas, 0, front, 100, y);
    const auto [bx, by] = place(atlas, 1, back, 100, y);
    const std::uint8_t* f = atlas.rgb.at(fx, fy);
    EXPECT_LE(off(atlas.rgb.at(bx, by), {f[0], f[1], f[2]}), 4);
  }
  for (const double g : atlas.panels[1].gain) EXPECT_NEAR(g, 1 / 0.85, 0.03);
  EXPECT_EQ(atlas.panels[0].gain, (std::array<double, 3>{1, 1, 1}));
}

TEST(Atlas, turns_neither_panels_texture_inside_out) {
  const Shot front = shoot(Side::front, 500, plain), back = shoot(Side::back, 500, plain);
  const Atlas atlas = make({&front, &back});
  // The mesh that is written winds outwards: the back's triangles are turned over.
  for (std::size_t panel : {0u, 1u})
    for (const Triangle& t : front.mesh.triangles) {
      const Vec2 a = atlas.uv[panel][t[1]] - atlas.uv[panel][t[0]], b = atlas.uv[panel][t[2]] - atlas.uv[panel][t[0]];
      const double area = a.x() * b.y() - a.y() * b.x();
      EXPECT_LT(panel == 0 ? area : -area, 0);  // v runs down
    }
}

/// Plain cloth with a red print on the chest.
Rgb printed(const Vec2& p) {
  return std::abs(p.x()) < 0.06 && p.y() > 0.25 && p.y() < 0.35 ? Rgb{190, 30, 40} : plain(p);
}

TEST(Atlas, takes_the_print_off_a_back_that_was_borrowed_from_the_front) {
  const Shot front = shoot(Side::front, 600, printed), back = shoot(Side::back, 600, printed);
  TextureSource sources[] = {front.source(), back.source()};
  sources[1].borrowed = true;
  const auto atlas = make_atlas(sources);
  ASSERT_TRUE(atlas);
  for (int y = 60; y < back.rgb.height - 60; y += 3)
    for (int x = 60; x < back.rgb.width - 60; x += 3) {
      const auto [bx, by] = place(*atlas, 1, back, x, y);
      ASSERT_LE(off(atlas->rgb.at(bx, by), plain({})), 6) << x << "," << y;
    }
  const auto [fx, fy] = place(*atlas, 0, front, front.rgb.width / 2, front.rgb.height - 21 - 180);
  EXPECT_LE(off(atlas->rgb.at(fx, fy), {190, 30, 40}), 0);
  EXPECT_NEAR(atlas->panels[1].print_share, 0.06, 0.02);
  EXPECT_EQ(atlas->panels[0].print_share, 0);
}

TEST(Atlas, leaves_a_pattern_all_over_on_a_borrowed_back) {
  const Shot front = shoot(Side::front, 600, striped), back = shoot(Side::back, 600, striped);
  TextureSource sources[] = {front.source(), back.source()};
  sources[1].borrowed = true;
  const auto atlas = make_atlas(sources);
  ASSERT_TRUE(atlas);
  EXPECT_EQ(atlas->panels[1].print_share, 0);
  for (int y = 30; y < back.rgb.height - 30; y += 7) {
    const auto [bx, by] = place(*atlas, 1, back, 100, y);
    const std::uint8_t* p = back.rgb.at(100, y);
    EXPECT_EQ(off(atlas->rgb.at(bx, by), {p[0], p[1], p[2]}), 0);
  }
}

TEST(Atlas, runs_stripes_on_through_a_hole_as_wide_as_a_collar) {
  Shot back = shoot(Side::back, 600, striped);
  const Shot whole = back;
  for (int y = 20; y < 120; ++y)
    for (int x = 90; x < 180; ++x) {
      *back.labels.at(x, y) = label_inside;
      const Rgb label{250, 250, 250};
      for (int k = 0; k < 3; ++k) back.rgb.at(x, y)[k] = static_cast<std::uint8_t>(label[k]);
    }
  const Atlas atlas = make({&back});
  int wrong = 0, seen = 0;
  for (int y = 24; y < 120; y += 2)
    for (int x = 92; x < 178; x += 2) {
      const auto [ax, ay] = place(atlas, 0, back, x, y);
      const std::uint8_t* p = whole.rgb.at(x, y);
      wrong += off(atlas.rgb.at(ax, ay), {p[0], p[1], p[2]}) > 40;
      ++seen;
    }
  EXPECT_LT(wrong, seen / 12);
  EXPECT_GT(atlas.panels[0].filled_share, 0.05);
}

TEST(Atlas, leaves_a_back_of_another_colour_alone) {
  const Shot front = shoot(Side::front, 500, plain);
  const Shot back = shoot(Side::back, 500, [](const Vec2&) { return Rgb{40, 60, 150}; });
  const Atlas atlas = make({&front, &back});
  const auto [x, y] = place(atlas, 1, back, 100, 100);
  EXPECT_EQ(off(atlas.rgb.at(x, y), {40, 60, 150}), 0);
}

TEST(Atlas, is_the_same_bytes_twice) {
  const Shot front = shoot(Side::front, 900, striped, true), back = shoot(Side::back, 650, striped, true);
  const Atlas a = make({&front, &back}), b = make({&front, &back});
  EXPECT_EQ(a.rgb.data, b.rgb.data);
  EXPECT_EQ(a.uv, b.uv);
}

TEST(Atlas, takes_a_panel_that_overhangs_its_photo) {
  Shot front = shoot(Side::front, 500, plain);
  front.panel.pixel_from_panel.origin.x() += 60;
  make({&front});
}

TEST(Atlas, refuses_sources_that_contradict_themselves) {
  const Shot good = shoot(Side::front, 400, plain);
  const auto code = [](const Shot& s) {
    const TextureSource source = s.source();
    const auto atlas = make_atlas(std::span(&source, 1));
    return atlas ? std::string() : atlas.error().code;
  };
  EXPECT_EQ(code(good), "");
  Shot none = good;
  std::fill(none.labels.data.begin(), none.labels.data.end(), label_background);
  EXPECT_EQ(code(none), "NO_TEXTURE");
  Shot nan = good;
  nan.mesh.nodes[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code(nan), "BAD_TEXTURE_SOURCE");
  Shot far = good;
  far.mesh.nodes[3].x() = 1e7;
  EXPECT_EQ(code(far), "BAD_TEXTURE_SOURCE");
  Shot torn = good;
  torn.labels = Image(10, 10, 1);
  EXPECT_EQ(code(torn), "BAD_TEXTURE_SOURCE");
  Shot flat = good;
  flat.panel.pixel_from_panel.axis_x = Vec2::Zero();
  EXPECT_EQ(code(flat), "BAD_TEXTURE_SOURCE");
  EXPECT_FALSE(make_atlas({}));
}

}  // namespace
}  // namespace vitrine::test
