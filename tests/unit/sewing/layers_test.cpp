// SPDX-License-Identifier: GPL-3.0-or-later
// Front and back against each other.
#include "layers.hpp"

#include <gtest/gtest.h>

#include "audit.hpp"
#include "relax.hpp"
#include "residual.hpp"
#include "scene.hpp"
#include "vitrine/sewing.hpp"

namespace vitrine {
namespace {

using namespace sewing;

/// Two sheets of 0.3 m, front at z = `gap`, back at z = 0, hanging from their sewn upper corners.
struct TwoSheets {
  Pattern pattern;
  Nodes nodes;
  Cloth cloth;

  explicit TwoSheets(double gap) {
    const PanelMesh mesh = scene::grid_mesh(0.3, 0.3, 12, 12, {0, 0});
    pattern.meshes = {mesh, mesh};
    pattern.panels.resize(2);
    pattern.pairs = {{0, 12 * 13, 1, 12 * 13, 0}, {0, 12 * 13 + 12, 1, 12 * 13 + 12, 0}};
    int count = 0;
    nodes = number_nodes(pattern, std::vector<char>{1, 1}, count);
    cloth = build_cloth(pattern, nodes, count, scene::place_flat(pattern, 0), {1000, 300, 1e-5}, 0.2, 9.81, true);
    for (std::size_t p = 0; p < 2; ++p)
      for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
        cloth.x[3 * nodes[p][i] + 2] = p == 0 ? gap : 0;
        if (mesh.nodes[i].y() > 0.3 - 1e-9) cloth.pinned[nodes[p][i]] = 1;
      }
  }
  SelfContact found() const { return detect_self_contact(pattern, nodes, scatter(cloth, nodes)); }
};

TEST(Layers, tell_order_from_crossing) {
  const SelfContact apart = TwoSheets(0.005).found(), close = TwoSheets(0.0005).found(),
                    crossed = TwoSheets(-0.003).found();
  EXPECT_EQ(apart.close, 0);
  EXPECT_EQ(apart.crossed, 0);
  EXPECT_GT(close.close, 100);
  EXPECT_EQ(close.crossed, 0);
  EXPECT_GT(crossed.crossed, 100);
  EXPECT_NEAR(crossed.depth, 0.003, 1e-9);
}

TEST(Layers, draw_crossed_sheets_back_into_their_order_and_leave_them_there) {
  TwoSheets sheets(0.003);
  // The lower half of the front hangs through the back.
  for (std::size_t i = 0; i < sheets.pattern.meshes[0].nodes.size(); ++i)
    if (sheets.pattern.meshes[0].nodes[i].y() < 0.15) sheets.cloth.x[3 * sheets.nodes[0][i] + 2] = -0.004;
  EXPECT_GT(sheets.found().crossed, 50);
  Layers layers(sheets.pattern, sheets.nodes, 300);
  RelaxOptions o;
  o.residual = 1e-4;
  EXPECT_TRUE(relax(sheets.cloth, nullptr, o, &layers).converged);
  EXPECT_EQ(sheets.found().crossed, 0);
  EXPECT_LE(residual_of(sheets.cloth, nullptr, 0, &layers), 1.05e-4);
}

TEST(Layers, forces_are_the_slope_of_the_energy_and_cancel) {
  TwoSheets sheets(0.0005);
  Layers layers(sheets.pattern, sheets.nodes, 300);
  Packed x;
  pack(sheets.cloth.x, x);
  layers.look(x);
  Packed force(x.size(), 0.0);
  const double energy = layers.forces(x, force);
  EXPECT_GT(energy, 0);
  for (int a = 0; a < 3; ++a) {
    double sum = 0;
    for (int n = 0; n < sheets.cloth.size; ++n) sum += force[4 * n + a];
    EXPECT_NEAR(sum, 0, 1e-9);
  }
  const int node = static_cast<int>(sheets.nodes[0][6 * 13 + 6]);
  const double h = 1e-7;
  Packed moved = x, ignored(x.size(), 0.0);
  moved[4 * node + 2] += h;
  const double slope = (layers.forces(moved, ignored) - energy) / h;
  EXPECT_NEAR(-slope, force[4 * node + 2], 1e-3 * std::abs(force[4 * node + 2]) + 1e-6);
}

// A push that ended at once would throw a node to and fro over the depth from which on it is left alone.
TEST(Layers, let_go_of_what_is_crossed_deeply_little_by_little) {
  double before = 1;
  for (const double depth : {0.002, 0.009, 0.012, 0.015, 0.018, 0.0199}) {
    TwoSheets sheets(-depth);
    const std::vector<LayerPair> pairs =
        find_layers(sheets.pattern, sheets.nodes, scatter(sheets.cloth, sheets.nodes), 0.02);
    ASSERT_GT(pairs.size(), 100U) << depth;
    for (const LayerPair& pair : pairs) {
      EXPECT_NEAR(pair.hold, std::min(1.0, (0.02 - depth) / 0.01), 1e-9) << depth;
      EXPECT_LE(pair.hold, before + 1e-12);
    }
    before = pairs.front().hold;
  }
}

// Next to a seam the panels always touch. How far that reaches is a matter of the cloth: were it one of the mesh, the
// finest meshes would push at folds that coarser ones rightly leave alone, and never come to rest.
TEST(Layers, beside_a_seam_are_left_alone_over_the_same_width_on_every_mesh) {
  for (const int cells : {15, 30, 60}) {
    Pattern pattern;
    const PanelMesh mesh = scene::grid_mesh(0.3, 0.3, cells, cells, {0, 0});
    pattern.meshes = {mesh, mesh};
    pattern.panels.resize(2);
    for (int i = 0; i < static_cast<int>(mesh.nodes.size()); ++i)
      if (mesh.nodes[i].x() < 1e-9) pattern.pairs.push_back({0, i, 1, i, 0});
    int count = 0;
    const Nodes nodes = number_nodes(pattern, std::vector<char>(pattern.pairs.size(), 1), count);
    Positions x(2);
    for (std::size_t p = 0; p < 2; ++p)
      for (const Vec2& q : mesh.nodes) x[p].emplace_back(q.x(), q.y(), p == 0 && q.x() > 1e-9 ? -0.001 : 0);
    double nearest = 1;
    for (const LayerPair& pair : find_layers(pattern, nodes, x, 0.02))
      for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
        if (static_cast<int>(nodes[0][i]) == pair.node) nearest = std::min(nearest, mesh.nodes[i].x());
    EXPECT_GT(nearest, 0.03) << cells;
    EXPECT_LT(nearest, 0.07) << cells;
  }
}

}  // namespace
}  // namespace vitrine
