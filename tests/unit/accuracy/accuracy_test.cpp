// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/accuracy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

namespace vitrine {
namespace {

/// A tube around the y axis, open at both ends; `sides` flat sides of the same area.
TriMesh tube(double radius, double bottom, double top, int sides = 96, int rows = 8, const Vec2& centre = {0, 0}) {
  TriMesh mesh;
  for (int r = 0; r <= rows; ++r)
    for (int s = 0; s < sides; ++s) {
      const double angle = 2 * std::numbers::pi * s / sides;
      mesh.vertices.emplace_back(centre.x() + radius * std::sin(angle), bottom + (top - bottom) * r / rows,
                                 centre.y() + radius * std::cos(angle));
    }
  for (int r = 0; r < rows; ++r)
    for (int s = 0; s < sides; ++s) {
      const auto at = [&](int row, int side) { return static_cast<std::uint32_t>(row * sides + side % sides); };
      mesh.triangles.push_back({at(r, s), at(r, s + 1), at(r + 1, s)});
      mesh.triangles.push_back({at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)});
    }
  return mesh;
}

TriMesh sheet(double height) {
  TriMesh mesh;
  mesh.vertices = {{0, height, 0}, {1, height, 0}, {1, height, 1}, {0, height, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TriMesh joined(TriMesh a, const TriMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.triangles) a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return a;
}

TEST(SurfaceDistance, of_a_surface_to_itself_is_nothing) {
  const SurfaceDistance d = surface_distance(tube(0.15, 0.8, 1.4), tube(0.15, 0.8, 1.4), 3000);
  EXPECT_LT(d.max_mm, 1e-6);
}

TEST(SurfaceDistance, of_two_sheets_is_the_gap_between_them_in_every_figure) {
  const SurfaceDistance d = surface_distance(sheet(0), sheet(0.003), 2000);
  EXPECT_NEAR(d.mean_mm, 3, 1e-9);
  EXPECT_NEAR(d.p95_mm, 3, 1e-9);
  EXPECT_NEAR(d.max_mm, 3, 1e-9);
}

TEST(SurfaceDistance, of_two_tubes_is_the_difference_of_their_radii) {
  const SurfaceDistance d = surface_distance(tube(0.150, 0.8, 1.4, 720), tube(0.154, 0.8, 1.4, 720), 4000);
  EXPECT_NEAR(d.mean_mm, 4, 0.01);
  EXPECT_NEAR(d.p95_mm, 4, 0.01);
}

TEST(SurfaceDistance, looks_both_ways_so_that_cloth_which_only_one_of_them_has_counts) {
  const TriMesh whole = tube(0.15, 0.8, 1.4), shorter = tube(0.15, 1.0, 1.4);
  const SurfaceDistance one = surface_distance(whole, shorter, 6000), other = surface_distance(shorter, whole, 6000);
  EXPECT_NEAR(one.max_mm, 200, 2);
  EXPECT_NEAR(other.max_mm, 200, 2);
  // A third of the whole's samples lie 100 mm away on the mean, the shorter one's lie on it: both halves weigh the
  // same.
  EXPECT_NEAR(one.mean_mm, 100.0 / 3 / 2, 0.3);
  EXPECT_NEAR(other.mean_mm, one.mean_mm, 1e-9);
}

TEST(SurfaceDistance, does_not_depend_on_how_an_area_is_cut_into_triangles) {
  TriMesh slope = sheet(0);
  slope.vertices[2].y() = slope.vertices[1].y() = 0.01;  // from 0 to 10 mm
  TriMesh crowded = slope;                               // the upper half in many slivers, the lower in two triangles
  crowded.vertices = {{0, 0, 0}, {0.5, 0.005, 0}, {0.5, 0.005, 1}, {0, 0, 1}};
  crowded.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (int i = 0; i < 50; ++i) {
    const auto first = static_cast<std::uint32_t>(crowded.vertices.size());
    for (const double x : {0.5 + 0.01 * i, 0.51 + 0.01 * i})
      for (const double z : {0.0, 1.0}) crowded.vertices.emplace_back(x, 0.01 * x, z);
    crowded.triangles.push_back({first, first + 2, first + 1});
    crowded.triangles.push_back({first + 2, first + 3, first + 1});
  }
  const double coarse = surface_distance(slope, sheet(0), 5000).mean_mm;
  EXPECT_NEAR(surface_distance(crowded, sheet(0), 5000).mean_mm, coarse, 0.02);
  EXPECT_NEAR(coarse, 5, 0.03);
}

TEST(SurfaceDistance, gives_the_same_numbers_at_every_call) {
  const TriMesh a = tube(0.15, 0.8, 1.4), b = tube(0.16, 0.75, 1.4, 40);
  const SurfaceDistance one = surface_distance(a, b), two = surface_distance(a, b);
  EXPECT_EQ(one.mean_mm, two.mean_mm);
  EXPECT_EQ(one.p95_mm, two.p95_mm);
}

TEST(Girth, of_a_tube_is_its_circumference) {
  const auto girth = girth_at(tube(0.14, 0.8, 1.4, 720), 1.033, {0, 0});
  ASSERT_TRUE(girth);
  EXPECT_NEAR(*girth, 2 * std::numbers::pi * 0.14, 1e-4);
}

TEST(Girth, is_measured_at_a_row_of_vertices_as_well_as_between_two) {
  const auto girth = girth_at(tube(0.14, 0.8, 1.4, 720, 6), 1.0, {0, 0});
  ASSERT_TRUE(girth);
  EXPECT_NEAR(*girth, 2 * std::numbers::pi * 0.14, 1e-4);
}

TEST(Girth, leaves_out_sleeves_beside_the_trunk) {
  const TriMesh both = joined(tube(0.14, 0.8, 1.4, 720), tube(0.05, 0.9, 1.4, 60, 4, {0.25, 0}));
  const auto girth = girth_at(both, 1.05, {0, 0});
  ASSERT_TRUE(girth);
  EXPECT_NEAR(*girth, 2 * std::numbers::pi * 0.14, 1e-4);
}

TEST(Girth, is_unknown_where_no_cloth_goes_round) {
  EXPECT_FALSE(girth_at(tube(0.14, 0.8, 1.4), 1.5, {0, 0}));
  EXPECT_FALSE(girth_at(tube(0.14, 0.8, 1.4), 1.0, {1, 0}));
  TriMesh split = tube(0.14, 0.8, 1.4, 96, 1);
  split.triangles.resize(split.triangles.size() - 2);  // open in front
  EXPECT_FALSE(girth_at(split, 1.033, {0, 0}));
}

TEST(Hem, is_the_lowest_border_and_not_the_lowest_point_of_another) {
  const TriMesh garment = joined(tube(0.14, 0.8, 1.4), tube(0.05, 0.9, 1.3, 24, 3, {0.3, 0}));
  const auto hem = hem_height(garment);
  ASSERT_TRUE(hem);
  EXPECT_NEAR(*hem, 0.8, 1e-9);
}

TEST(Hem, of_a_slanting_border_is_its_mean_height) {
  TriMesh skirt = tube(0.2, 0.5, 1.0, 400, 1);
  for (int s = 0; s < 400; ++s) skirt.vertices[s].y() += 0.1 * skirt.vertices[s].x();
  const auto hem = hem_height(skirt);
  ASSERT_TRUE(hem);
  EXPECT_NEAR(*hem, 0.5, 1e-6);
}

TEST(Hem, is_unknown_for_a_surface_without_a_border) {
  TriMesh closed;
  closed.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  closed.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  EXPECT_FALSE(hem_height(closed));
}

TEST(GarmentSurface, joins_what_was_sewn_and_turns_the_back_outwards) {
  Pattern pattern;
  PanelMesh panel;
  panel.nodes = {{0, 0}, {1, 0}, {0, 1}};
  panel.triangles = {{0, 1, 2}};
  pattern.meshes = {panel, panel};
  Drape drape;
  drape.positions = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.2}}, {{0, 0, 0}, {1, 0, 0}, {0, 1, -0.2}}};
  drape.welded = {{0, 1, 2}, {0, 1, 3}};
  const TriMesh surface = garment_surface(pattern, drape);
  EXPECT_EQ(surface.vertices.size(), 4u);
  ASSERT_EQ(surface.triangles.size(), 2u);
  EXPECT_EQ(surface.triangles[0], (Triangle{0, 1, 2}));
  EXPECT_EQ(surface.triangles[1], (Triangle{0, 3, 1}));
}

TEST(ParetoFront, holds_what_nothing_else_undercuts_in_order_of_cost) {
  //                                    0  1  2  3  4  5
  const std::vector<double> cost = {3, 1, 2, 4, 2, 9}, error = {5, 9, 6, 5, 7, 1};
  EXPECT_EQ(pareto_front(cost, error), (std::vector<std::size_t>{1, 2, 0, 5}));
  EXPECT_TRUE(pareto_front({}, {}).empty());
}

TEST(Settings, of_the_full_grid_differ_from_standard_in_one_knob_each) {
  const Settings standard = settings_of(Quality::standard);
  std::set<std::string> names;
  for (const Setting& s : settings_to_measure(Grid::full)) {
    EXPECT_TRUE(names.insert(s.name).second) << s.name;
    if (s.knob.empty()) continue;
    const Settings& t = s.settings;
    const int turned = (t.level_nodes != standard.level_nodes) + (t.residual != standard.residual) +
                       (t.max_weight_strain != standard.max_weight_strain) + (t.bending != standard.bending) +
                       (t.friction != standard.friction) + (t.front_back != standard.front_back) +
                       (t.contact_between_nodes != standard.contact_between_nodes) +
                       (t.photo_side != standard.photo_side) + (s.voxel > 0) +
                       (t.max_iterations != standard.max_iterations);
    EXPECT_EQ(turned, 1) << s.name;
  }
  EXPECT_EQ(settings_to_measure(Grid::none).size(), 3u);
  EXPECT_LT(settings_to_measure(Grid::shortened).size(), names.size());
}

TEST(Settings, levels_grow_by_a_step_that_is_worth_one) {
  EXPECT_EQ(levels_up_to({300, 2000, 6500}, 8000), (std::vector<int>{300, 2000, 8000}));
  EXPECT_EQ(levels_up_to({300, 2000}, 300), (std::vector<int>{300}));
}

TEST(RunsCsv, names_every_column_and_leaves_unknown_figures_empty) {
  RunRow row;
  row.item = "vest, blue";
  row.source = "shop \"A\"";
  row.setting = "draft";
  row.status = "NO_GARMENT";
  row.iou = 0.9125;
  const std::string csv = runs_csv({row});
  EXPECT_EQ(
      csv,
      "item,source,garment,setting,knob,value,nodes,residual,status,cpu_ms,sewing_ms,peak_mb,mean_mm,p95_mm,max_mm,"
      "hem_mm,waist_mm,chest_mm,iou,landmark_mm,seam_gap_mm,penetration_mm,estimate_mm,spread_mm\n"
      "\"vest, blue\",\"shop \"\"A\"\"\",,draft,,,0,0,NO_GARMENT,0,0,0,,,,,,,0.9125,,,,,\n");
}

TEST(MeansBySetting, leave_out_what_was_refused_or_has_no_reference) {
  RunRow a, b, refused;
  a.setting = b.setting = refused.setting = "draft";
  a.seam_gap_mm = b.seam_gap_mm = 0.5;
  a.cpu_ms = 100, b.cpu_ms = 300, refused.cpu_ms = 5;
  a.mean_mm = 6;
  const auto means = means_by_setting({a, b, refused});
  ASSERT_EQ(means.size(), 1u);
  EXPECT_EQ(means[0].items, 3);
  EXPECT_EQ(means[0].refused, 1);
  EXPECT_DOUBLE_EQ(means[0].cpu_ms, 200);
  EXPECT_EQ(means[0].with_reference, 1);
  EXPECT_DOUBLE_EQ(means[0].mean_mm, 6);
}

TEST(Measure, an_item_that_is_refused_or_whose_process_dies_is_a_row_with_its_status) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "vitrine-measure-refused";
  std::filesystem::remove_all(folder);
  MeasuredItem refused{"a", "shop", {}, Error{Cause::unusable, "PRODUCT_ROW", "row 3 is none", "mend it", ""}};
  MeasuredItem dies{"b", "shop", {}, {}};  // photos that are not there, and no mannequin
  dies.request.front = dies.request.back = "/nowhere.jpg";
  MeasureOptions options;
  options.out_dir = folder.string();
  options.jobs = 2;
  const auto measurement = measure({refused, dies}, options);
  ASSERT_TRUE(measurement) << measurement.error().message;
  ASSERT_GE(measurement->runs.size(), 2u);
  EXPECT_EQ(measurement->runs.front().item, "a");
  EXPECT_EQ(measurement->runs.front().status, "PRODUCT_ROW");
  EXPECT_EQ(measurement->runs.back().item, "b");
  EXPECT_FALSE(measurement->runs.back().status.empty());
  EXPECT_TRUE(std::filesystem::exists(folder / "runs.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder / "pareto.svg"));
  EXPECT_TRUE(measurement->references.empty());
}

}  // namespace
}  // namespace vitrine
