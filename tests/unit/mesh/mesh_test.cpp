// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/mesh.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <limits>
#include <map>
#include <set>

#include "outlines.hpp"
#include "validity.hpp"

namespace vitrine {
namespace {

using test::area;
using test::distance_to;
using test::expect_valid;
using test::Outline;

PanelMesh meshed(const Outline& outline, double h) {
  auto mesh = mesh_panel(outline, {.edge_length = h});
  EXPECT_TRUE(mesh) << mesh.error().message;
  return mesh ? *mesh : PanelMesh{};
}

using Shape = Outline (*)(double);
constexpr std::array<Shape, 5> kGarments = {test::vest, test::v_neck, test::sleeves, test::skirt, test::belt};

class MeshOfGarments : public testing::TestWithParam<std::tuple<Shape, double>> {};

TEST_P(MeshOfGarments, is_a_valid_mesh_of_the_outline) {
  const auto [shape, h] = GetParam();
  const Outline outline = shape(h);
  expect_valid(outline, meshed(outline, h));
}

TEST_P(MeshOfGarments, keeps_interior_nodes_off_the_wall) {
  const auto [shape, h] = GetParam();
  const Outline outline = shape(h);
  const PanelMesh mesh = meshed(outline, h);
  for (std::size_t i = outline.size(); i < mesh.nodes.size(); ++i)
    ASSERT_GT(distance_to(outline, mesh.nodes[i]), 0.4 * std::min(h, 0.03));  // the belt is 3 cm wide
}

TEST_P(MeshOfGarments, is_as_good_mirrored) {
  const auto [shape, h] = GetParam();
  const Outline outline = shape(h);
  Outline mirror(outline.rbegin(), outline.rend());
  for (Vec2& p : mirror) p = test::mirrored(p);
  const PanelMesh mesh = meshed(mirror, h);
  expect_valid(mirror, mesh);
  const MeshStats a = measure_mesh(meshed(outline, h)), b = measure_mesh(mesh);
  EXPECT_NEAR(a.nodes, b.nodes, 2 + 0.02 * a.nodes);
  EXPECT_NEAR(a.mean_min_angle_deg, b.mean_min_angle_deg, 1.0);
  EXPECT_NEAR(a.edge_cv, b.edge_cv, 0.02);
}

INSTANTIATE_TEST_SUITE_P(coarse_standard_fine, MeshOfGarments,
                         testing::Combine(testing::ValuesIn(kGarments), testing::Values(0.05, 0.02, 0.007)));

/// By nodes that a uniform mesh would have; the bars of the comparison in docs/TESTING.md.
class QualityOfGarments : public testing::TestWithParam<std::tuple<Shape, double>> {};

TEST_P(QualityOfGarments, meets_the_bars) {
  const auto [shape, nodes] = GetParam();
  const double h = std::sqrt(area(shape(0.005)) / (nodes * 0.866));
  const MeshStats stats = measure_mesh(meshed(shape(h), h));
  EXPECT_EQ(stats.flat_share, 0);
  EXPECT_GE(stats.good_share, nodes > 5000 ? 0.985 : 0.96);
  EXPECT_GE(stats.mean_min_angle_deg, 55);
  EXPECT_GE(stats.min_angle_deg, 35);
  EXPECT_LE(stats.edge_cv, nodes > 5000 ? 0.045 : 0.075);
  EXPECT_GE(stats.valence6_share, nodes > 5000 ? 0.95 : 0.89);
}

INSTANTIATE_TEST_SUITE_P(standard_fine, QualityOfGarments,
                         testing::Combine(testing::Values(test::vest, test::sleeves, test::skirt),
                                          testing::Values(900.0, 1000.0, 1100.0, 10000.0)));

TEST(Quality, of_straps_two_edges_wide_is_what_grading_leaves) {
  for (double h : {0.0202, 0.02, 0.018}) {
    const MeshStats stats = measure_mesh(meshed(test::v_neck(h), h));
    EXPECT_EQ(stats.flat_share, 0);
    EXPECT_GE(stats.min_angle_deg, 27);
    EXPECT_LE(stats.edge_cv, 0.12);
  }
}

class MeshOfRandomOutlines : public testing::TestWithParam<std::uint32_t> {};

TEST_P(MeshOfRandomOutlines, is_valid_for_blobs_and_stars_of_every_size) {
  test::Random random(GetParam());
  const double h = random.between(0.008, 0.06);
  for (const Outline& outline : {test::blob(GetParam(), h), test::star(GetParam(), h)})
    expect_valid(outline, meshed(outline, h));
}

TEST_P(MeshOfRandomOutlines, meets_the_bars_on_smooth_blobs) {
  const MeshStats stats = measure_mesh(meshed(test::blob(GetParam(), 0.02), 0.02));
  EXPECT_LE(stats.flat_share, 0.0005);
  EXPECT_GE(stats.mean_min_angle_deg, 54);
  EXPECT_GE(stats.min_angle_deg, 28);
  EXPECT_LE(stats.edge_cv, 0.09);
}

TEST_P(MeshOfRandomOutlines, does_not_fall_out_with_uneven_outlines) {
  // Segments from a fifth to five times the target: quality is the caller's to answer for, validity is ours.
  test::Random random(GetParam());
  Outline outline;
  const int n = 12 + static_cast<int>(random.between(0, 60));
  for (int i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * (i + random.between(0.05, 0.95)) / n, r = random.between(0.1, 0.4);
    outline.push_back({r * std::cos(a), r * std::sin(a)});
  }
  expect_valid(outline, meshed(outline, 0.02));
}

INSTANTIATE_TEST_SUITE_P(seeds, MeshOfRandomOutlines, testing::Range(1u, 31u));

TEST(Mesh, is_the_same_bytes_twice) {
  const Outline outline = test::sleeves(0.02);
  const PanelMesh a = meshed(outline, 0.02), b = meshed(outline, 0.02);
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  EXPECT_EQ(std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(Vec2)), 0);
  EXPECT_EQ(a.triangles, b.triangles);
}

TEST(Mesh, has_about_the_nodes_that_the_area_asks_for) {
  const Outline outline = test::vest(0.02);
  const double ideal = (area(outline) / (0.4330127 * 0.02 * 0.02) + static_cast<double>(outline.size()) + 2) / 2;
  EXPECT_NEAR(static_cast<double>(meshed(outline, 0.02).nodes.size()), ideal, 0.03 * ideal);
}

TEST(Mesh, fills_the_inside_where_the_outline_is_coarse) {
  const Outline square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const PanelMesh mesh = meshed(square, 0.05);
  expect_valid(square, mesh);
  EXPECT_GT(mesh.nodes.size(), 300u);
}

TEST(Mesh, of_a_single_triangle_is_that_triangle) {
  const Outline outline = {{0, 0}, {0.02, 0}, {0.01, 0.017}};
  EXPECT_EQ(meshed(outline, 0.02).triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(Mesh, does_not_depend_on_where_the_panel_lies) {
  Outline far = test::vest(0.02);
  for (Vec2& p : far) p += Vec2(1000, -2000);
  const MeshStats here = measure_mesh(meshed(test::vest(0.02), 0.02)), there = measure_mesh(meshed(far, 0.02));
  EXPECT_NEAR(here.mean_min_angle_deg, there.mean_min_angle_deg, 0.7);
  EXPECT_NEAR(here.nodes, there.nodes, 15);
}

TEST(Mesh, refuses_degenerate_outlines) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const std::vector<Outline> bad = {
      {},
      {{0, 0}, {1, 0}},
      {{0, 0}, {1, 0}, {2, 0}},                            // no area
      {{0, 0}, {1, 1}, {1, 0}, {0, 1}},                    // crosses itself
      {{0, 0}, {1, 0}, {1, 0}, {0, 1}},                    // repeated neighbour
      {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {-1, 1}, {-1, 0}},  // repeated far point
      {{0, 0}, {2, 0}, {2, 1}, {1, 0}, {0, 1}},            // a point on a segment
      {{0, 0}, {1, 0}, {2, 0}, {1.5, 0}, {1, 1}},          // a fold back
      {{0, 0}, {1, 0}, {nan, 1}},
      {{0, 0}, {inf, 0}, {0, 1}},
      {{-1e308, 0}, {1e308, 0}, {0, 1e308}},
  };
  for (const Outline& outline : bad) {
    const auto mesh = mesh_panel(outline, {.edge_length = 0.1});
    ASSERT_FALSE(mesh) << outline.size();
    EXPECT_EQ(mesh.error().code, "DEGENERATE_OUTLINE");
    EXPECT_EQ(mesh.error().exit_code(), 65);
  }
}

TEST(Mesh, refuses_outlines_that_need_too_many_nodes) {
  const Outline square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, needle = {{0, 0}, {1e4, 1e4}, {1e4, 1e4 + 1e-3}};
  Outline circle;
  for (int i = 0; i < 1'000'000; ++i) {
    const double a = 2 * std::numbers::pi * i / 1e6;
    circle.push_back({std::cos(a), std::sin(a)});
  }
  for (const auto& mesh : {mesh_panel(square, {.edge_length = 1e-4}), mesh_panel(square, {.edge_length = 1e-300}),
                           mesh_panel(square, {.edge_length = 0.02, .max_nodes = 500}), mesh_panel(circle, {}),
                           mesh_panel(needle, {.edge_length = 0.02})}) {
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().code, "TOO_MANY_NODES");
    EXPECT_EQ(mesh.error().exit_code(), 65);
  }
}

TEST(Mesh, refuses_settings_without_meaning) {
  const Outline square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (double h : {0.0, -0.02, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(mesh_panel(square, {.edge_length = h}).error().exit_code(), 64);
  EXPECT_EQ(mesh_panel(square, {.edge_length = 0.1, .max_nodes = 0}).error().exit_code(), 64);
}

TEST(Mesh, holds_its_bound_on_nodes) {
  const Outline outline = test::vest(0.02);
  const auto mesh = mesh_panel(outline, {.edge_length = 0.02, .max_nodes = 900});
  ASSERT_TRUE(mesh);
  EXPECT_LE(mesh->nodes.size(), 900u);
}

TEST(Mesh, is_valid_without_any_relaxation) {
  const Outline outline = test::sleeves(0.02);
  const auto mesh = mesh_panel(outline, {.edge_length = 0.02, .max_sweeps = 0});
  ASSERT_TRUE(mesh);
  expect_valid(outline, *mesh);
}

TEST(Stats, know_the_figures_of_a_hand_made_mesh) {
  const PanelMesh mesh{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}}};
  const MeshStats stats = measure_mesh(mesh);
  EXPECT_EQ(stats.nodes, 4);
  EXPECT_EQ(stats.triangles, 2);
  EXPECT_NEAR(stats.min_angle_deg, 45, 1e-9);
  EXPECT_NEAR(stats.mean_min_angle_deg, 45, 1e-9);
  EXPECT_EQ(stats.flat_share, 0);  // ratio sqrt(2)
  const double mean = (4 + std::sqrt(2)) / 5;
  EXPECT_NEAR(stats.edge_cv, std::sqrt(6.0 / 5 - mean * mean) / mean, 1e-12);
  const PanelMesh flat{{{0, 0}, {1, 0}, {0.5, 0.2}}, {{0, 1, 2}}};
  EXPECT_EQ(measure_mesh(flat).flat_share, 1);
  EXPECT_EQ(measure_mesh({}).triangles, 0);
}

}  // namespace
}  // namespace vitrine
