// SPDX-License-Identifier: GPL-3.0-or-later
#include <limits>

#include "validity.hpp"

namespace vitrine {
namespace {

using test::Outline;

Outline round_hole(const Vec2& middle, double radius, double h) {
  const int n = std::max(3, static_cast<int>(std::lround(2 * std::numbers::pi * radius / h)));
  Outline hole;
  for (int i = 0; i < n; ++i)
    hole.push_back(middle +
                   radius * Vec2(std::cos(2 * std::numbers::pi * i / n), std::sin(2 * std::numbers::pi * i / n)));
  return hole;
}

TEST(Holes, keep_their_nodes_after_those_of_the_outline_in_the_order_given) {
  const double h = 0.02;
  Outline clockwise = round_hole({0.1, 1.2}, 0.04, h);
  std::reverse(clockwise.begin(), clockwise.end());
  const std::vector<Outline> holes = {round_hole({-0.1, 1.1}, 0.06, h), clockwise};
  const Outline outline = test::vest(h);
  const auto mesh = mesh_panel(outline, {.edge_length = h}, holes);
  ASSERT_TRUE(mesh) << mesh.error().message;
  test::expect_valid(outline, *mesh, holes);
  const MeshStats stats = measure_mesh(*mesh);
  EXPECT_GE(stats.min_angle_deg, 35);
  EXPECT_EQ(stats.flat_share, 0);
  EXPECT_GE(stats.good_share, 0.96);
}

TEST(Holes, may_be_a_single_triangle_or_almost_all_of_the_panel) {
  const Outline square = test::joined({{{0, 0}, {1, 0}}, {{1, 0}, {1, 1}}, {{1, 1}, {0, 1}}, {{0, 1}, {0, 0}}}, 0.05);
  Outline most = square;
  for (Vec2& p : most) p = Vec2(0.5, 0.5) + 0.9 * (p - Vec2(0.5, 0.5));
  const std::vector<std::vector<Outline>> cases = {{{{0.5, 0.5}, {0.55, 0.5}, {0.525, 0.54}}}, {most}};
  for (const auto& holes : cases) {
    const auto mesh = mesh_panel(square, {.edge_length = 0.05}, holes);
    ASSERT_TRUE(mesh) << mesh.error().message;
    test::expect_valid(square, *mesh, holes);
    EXPECT_GE(test::smallest_angle(test::Rim(square, holes), *mesh, 15), 20);
  }
}

TEST(Holes, that_touch_cross_or_leave_the_outline_are_refused) {
  const Outline square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, small = {{.4, .4}, {.6, .4}, {.6, .6}, {.4, .6}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::vector<Outline>> bad = {
      {{{.5, .5}, {1.5, .5}, {.5, .6}}},             // crosses the outline
      {{{2, 2}, {3, 2}, {2, 3}}},                    // outside
      {{{.5, 0}, {.6, .3}, {.4, .3}}},               // a corner on the outline
      {{{0, 0}, {.5, .2}, {.2, .5}}},                // a shared node
      {small, {{.45, .45}, {.55, .45}, {.5, .55}}},  // a hole in a hole
      {small, {{.5, .5}, {.8, .5}, {.8, .8}}},       // two that cross
      {small, small},                                // twice
      {{{.2, .2}, {.8, .8}, {.8, .2}, {.2, .8}}},    // crosses itself
      {{{.2, .2}, {.4, .2}}},
      {{}},
      {{{.2, .2}, {.4, .2}, {.6, .2}}},
      {{{.2, .2}, {.4, .2}, {.3, nan}}},
      {{{-1, -1}, {2, -1}, {2, 2}, {-1, 2}}},  // around the outline
  };
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const auto mesh = mesh_panel(square, {.edge_length = 0.1}, bad[i]);
    ASSERT_FALSE(mesh) << i;
    EXPECT_EQ(mesh.error().code, "DEGENERATE_OUTLINE") << i;
    EXPECT_FALSE(mesh.error().remedy.empty()) << i;
  }
}

}  // namespace
}  // namespace vitrine
