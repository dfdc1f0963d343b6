// SPDX-License-Identifier: GPL-3.0-or-later
// Edges are finer where a part is narrower than four of them, and only there.
#include "validity.hpp"

namespace vitrine {
namespace {

using test::Outline;

/// A body 40 cm wide with a strap on it.
Outline strap(double width, double h) {
  const double x = 0.2 - width / 2, y = 0.2 + width / 2;
  return test::joined({{{0, 0}, {.4, 0}},
                       {{.4, 0}, {.4, .4}},
                       {{.4, .4}, {y, .4}},
                       {{y, .4}, {y, .7}},
                       {{y, .7}, {x, .7}},
                       {{x, .7}, {x, .4}},
                       {{x, .4}, {0, .4}},
                       {{0, .4}, {0, 0}}},
                      h);
}

PanelMesh meshed_soundly(const Outline& outline, double h) {
  auto mesh = mesh_panel(outline, {.edge_length = h});
  EXPECT_TRUE(mesh) << mesh.error().message;
  if (!mesh) return {};
  test::expect_valid(outline, *mesh);
  return *mesh;
}

/// Mean length [m] of the inner edges whose middle satisfies the condition.
template <class Where>
double mean_edge(const PanelMesh& mesh, std::size_t outline, Where&& where) {
  double sum = 0;
  int count = 0;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if ((a < outline && b < outline) || !where(Vec2(0.5 * (mesh.nodes[a] + mesh.nodes[b])))) continue;
      sum += (mesh.nodes[a] - mesh.nodes[b]).norm();
      ++count;
    }
  return count > 0 ? sum / count : 0;
}

TEST(Grading, gives_a_strap_finer_edges_and_the_body_none) {
  const double h = 0.02;
  for (const double edges : {2.0, 2.5, 3.0}) {
    const Outline outline = strap(edges * h, h);
    const PanelMesh mesh = meshed_soundly(outline, h);
    const double in_strap = mean_edge(mesh, outline.size(), [](const Vec2& p) { return p.y() > 0.44 && p.y() < 0.66; });
    const double in_body = mean_edge(mesh, outline.size(), [](const Vec2& p) { return p.y() < 0.34; });
    EXPECT_LT(in_strap, 0.9 * h) << edges;
    EXPECT_GT(in_strap, 0.4 * h) << edges;
    EXPECT_NEAR(in_body, h, 0.03 * h) << edges;
    EXPECT_GE(measure_mesh(mesh).min_angle_deg, 25) << edges;
  }
}

TEST(Grading, leaves_parts_of_four_edges_and_more_alone) {
  const double h = 0.02;
  const Outline outline = strap(4.2 * h, h);
  const PanelMesh mesh = meshed_soundly(outline, h);
  EXPECT_NEAR(mean_edge(mesh, outline.size(), [](const Vec2& p) { return p.y() > 0.44 && p.y() < 0.66; }), h, 0.07 * h);
}

TEST(Grading, does_not_take_a_corner_for_a_narrow_part) {
  const double h = 0.02;
  const Outline triangle = test::joined({{{0, 0}, {.5, 0}}, {{.5, 0}, {.25, .433}}, {{.25, .433}, {0, 0}}}, h);
  const MeshStats stats = measure_mesh(meshed_soundly(triangle, h));
  EXPECT_NEAR(stats.edge_mean, h, 0.02 * h);
  EXPECT_LE(stats.edge_cv, 0.05);
}

TEST(Grading, keeps_straps_of_one_centimetre_valid_at_every_edge_length) {
  for (const double h : {0.005, 0.01, 0.02, 0.04}) {
    const Outline outline = strap(0.01, h);
    const PanelMesh mesh = meshed_soundly(outline, h);
    EXPECT_GE(test::smallest_angle(test::Rim(outline, {}), mesh, 15), h > 0.03 ? 5 : 15) << h;
  }
}

TEST(Grading, keeps_sharp_triangles_off_walls_of_any_spacing_up_to_three_targets) {
  const double h = 0.02;
  for (const double spacing : {0.2, 0.3, 0.5, 0.7, 1.0, 1.3, 1.5, 2.0, 2.5, 3.0})
    for (const auto shape : {test::vest, test::skirt})
      EXPECT_GE(measure_mesh(meshed_soundly(shape(spacing * h), h)).min_angle_deg, 20) << spacing;
}

TEST(Grading, is_bounded_where_the_outline_is_far_finer_or_coarser_than_the_target) {
  Outline circle;
  for (int i = 0; i < 20000; ++i) {
    const double a = 2 * std::numbers::pi * i / 20000;
    circle.push_back({0.3 * std::cos(a), 0.3 * std::sin(a)});
  }
  EXPECT_LT(meshed_soundly(circle, 0.02).nodes.size(), 60000u);
  const PanelMesh square = meshed_soundly({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0.01);
  EXPECT_NEAR(static_cast<double>(square.nodes.size()), 11547, 400);
}

TEST(Grading, goes_with_segments_that_are_shorter_than_the_target) {
  // One segment of a tenth of the target among regular ones.
  Outline outline =
      test::joined({{{0, 0}, {.4, 0}}, {{.4, 0}, {.4, .4}}, {{.4, .4}, {0, .4}}, {{0, .4}, {0, 0}}}, 0.02);
  outline.insert(outline.begin() + 11, outline[10] + Vec2(0.002, 0));
  const PanelMesh mesh = meshed_soundly(outline, 0.02);
  EXPECT_GE(measure_mesh(mesh).min_angle_deg, 20);
  EXPECT_NEAR(mean_edge(mesh, outline.size(), [](const Vec2& p) { return p.y() > 0.1; }), 0.02, 0.0005);
}

}  // namespace
}  // namespace vitrine
