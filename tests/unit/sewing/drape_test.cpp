// SPDX-License-Identifier: GPL-3.0-or-later
// Whole garments on a synthetic woman.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "scene.hpp"
#include "vitrine/sewing.hpp"

namespace vitrine {
namespace {

using Placed = std::vector<std::vector<Vec3>>;

std::vector<Pattern> levels_of(const scene::Outline& outline, std::initializer_list<double> edges) {
  std::vector<Pattern> out;
  for (const double h : edges) out.push_back(scene::make_pattern(outline, h));
  return out;
}

Drape must(Result<Drape> r) {
  if (!r) ADD_FAILURE() << r.error().code << ": " << r.error().message;
  return r ? *std::move(r) : Drape{};
}

Drape dress(const scene::Outline& outline, std::initializer_list<double> edges, const SewingOptions& options = {},
            const Fabric& fabric = scene::cotton()) {
  const auto levels = levels_of(outline, edges);
  return must(sew_and_drape(levels, scene::place_flat(levels.front(), 0.16), fabric, scene::woman(), options));
}

bool finite(const Drape& d) {
  for (const auto& panel : d.positions)
    for (const Vec3& p : panel)
      if (!p.allFinite()) return false;
  return true;
}

bool same_bytes(const Placed& a, const Placed& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t p = 0; p < a.size(); ++p)
    if (a[p].size() != b[p].size() || std::memcmp(a[p].data(), b[p].data(), a[p].size() * sizeof(Vec3)) != 0)
      return false;
  return true;
}

class Garments : public testing::TestWithParam<const char*> {
 protected:
  scene::Outline outline() const {
    const std::string name = GetParam();
    return name == "vest"       ? scene::vest()
           : name == "skirt"    ? scene::skirt()
           : name == "trousers" ? scene::trousers()
                                : scene::long_sleeve();
  }
};

TEST_P(Garments, come_to_rest_sewn_and_outside_the_body) {
  const auto levels = levels_of(outline(), {0.05, 0.028});
  SewingOptions o;
  const Drape d =
      must(sew_and_drape(levels, scene::place_flat(levels.front(), 0.16), scene::cotton(), scene::woman(), o));
  EXPECT_EQ(d.status, "OK") << d.detail;
  EXPECT_LE(d.residual, 1.05e-3);
  EXPECT_LE(d.seam_gap_mm_max, 3);
  EXPECT_LE(d.penetration_mm_max, 0.5);
  EXPECT_LT(d.strain_p99, 0.2);
  ASSERT_EQ(d.levels.size(), 2u);
  ASSERT_EQ(d.positions[0].size(), levels.back().meshes[0].nodes.size());
  for (const NodePair& q : levels.back().pairs) {
    EXPECT_EQ(d.welded[q.panel_a][q.node_a], d.welded[q.panel_b][q.node_b]);
    EXPECT_EQ(d.positions[q.panel_a][q.node_a], d.positions[q.panel_b][q.node_b]);
  }
  // The body stays between the panels: front before back at every seamless node of the middle.
  double front = 0, back = 0;
  for (std::size_t i = 0; i < d.positions[0].size(); ++i) front += d.positions[0][i].z(), back += d.positions[1][i].z();
  EXPECT_GT(front, back);
  EXPECT_FALSE(d.modelled.empty());
  EXPECT_FALSE(d.skipped.empty());
}

INSTANTIATE_TEST_SUITE_P(Of, Garments, testing::Values("vest", "skirt", "long_sleeve", "trousers"));

TEST(Drape, trousers_are_one_piece_at_the_crotch_with_a_leg_on_either_side) {
  const Pattern p = scene::make_pattern(scene::trousers(), 0.03);
  const Drape d = dress(scene::trousers(), {0.05, 0.03});
  ASSERT_EQ(d.status, "OK") << d.detail;
  int crotch = 0;
  for (std::size_t i = 0; i < p.meshes[0].nodes.size(); ++i)
    if ((p.meshes[0].nodes[i] - Vec2(0, 0.74)).norm() < 1e-9) crotch = static_cast<int>(i);
  EXPECT_EQ(d.welded[0][crotch], d.welded[1][crotch]) << "front and back share one node there";
  EXPECT_NEAR(d.positions[0][crotch].x(), 0, 0.02);
  for (int panel = 0; panel < 2; ++panel)
    for (std::size_t i = 0; i < p.meshes[panel].nodes.size(); ++i) {
      const Vec2 flat = p.meshes[panel].nodes[i];
      // Well below the crotch each leg's cloth stays around its own leg.
      EXPECT_TRUE(flat.y() > 0.60 || std::abs(flat.x()) < 0.03 || flat.x() * d.positions[panel][i].x() > 0);
    }
}

TEST(Drape, nodes_stay_above_nine_tenths_of_the_skin_offset) {
  const Drape d = dress(scene::vest(), {0.04});
  double least = 1;
  for (const auto& panel : d.positions)
    for (const Vec3& p : panel) least = std::min(least, scene::woman().distance(p));
  EXPECT_GE(least, 0.9 * 0.004);
}

TEST(Drape, a_vest_comes_to_rest_without_friction) {
  SewingOptions o;
  o.friction = false;
  const Drape d = dress(scene::vest(), {0.05, 0.03}, o);
  EXPECT_EQ(d.status, "OK") << d.detail;
}

TEST(Drape, same_input_same_bytes) {
  const Drape a = dress(scene::long_sleeve(), {0.06, 0.04}), b = dress(scene::long_sleeve(), {0.06, 0.04});
  EXPECT_TRUE(same_bytes(a.positions, b.positions));
  EXPECT_EQ(a.residual, b.residual);
}

TEST(Drape, stiffness_and_mass_scaled_by_a_power_of_two_give_the_same_bytes) {
  const Fabric one = scene::cotton();
  Fabric scaled = one;
  for (double* v : {&scaled.stretch, &scaled.shear, &scaled.bend, &scaled.mass}) *v *= 1024;
  const Drape a = dress(scene::vest(), {0.05, 0.035}, {}, one), b = dress(scene::vest(), {0.05, 0.035}, {}, scaled);
  EXPECT_TRUE(same_bytes(a.positions, b.positions));
  EXPECT_EQ(a.levels.back().iterations, b.levels.back().iterations);
}

TEST(Drape, stiffness_above_the_cap_changes_nothing_and_is_reported) {
  Fabric stiff = scene::cotton(), stiffer = stiff;
  stiff.stretch = stiff.shear = 1e5;
  stiffer.stretch = stiffer.shear = 1e7;
  SewingOptions o;
  o.residual = 1e-2;
  const Drape a = dress(scene::vest(), {0.05}, o, stiff), b = dress(scene::vest(), {0.05}, o, stiffer);
  EXPECT_GT(a.stiffness_cap, 0);
  EXPECT_TRUE(same_bytes(a.positions, b.positions));
}

TEST(Drape, a_mirrored_scene_gives_a_mirrored_garment) {
  // A skirt-like tube on structured grids, mirror-symmetric down to the triangles.
  Pattern p;
  PanelMesh mesh = scene::grid_mesh(1, 0.45, 16, 12, {0, 0});
  for (Vec2& n : mesh.nodes) n = {(n.x() - 0.5) * (0.37 + (0.45 - n.y()) * 0.35), n.y() + 0.6};
  p.meshes = {mesh, mesh};
  p.panels.resize(2);
  for (int j = 0; j <= 12; ++j) {
    p.pairs.push_back({0, j * 17, 1, j * 17, 0});
    p.pairs.push_back({0, j * 17 + 16, 1, j * 17 + 16, 1});
  }
  const std::vector<Pattern> levels{p};
  const Drape d = must(sew_and_drape(levels, scene::place_flat(p, 0.16), scene::cotton(), scene::woman(), {}));
  EXPECT_EQ(d.status, "OK") << d.detail;
  double worst = 0;
  for (int s = 0; s < 2; ++s)
    for (int j = 0; j <= 12; ++j)
      for (int i = 0; i <= 16; ++i) {
        const Vec3 left = d.positions[s][j * 17 + i], right = d.positions[s][j * 17 + 16 - i];
        worst = std::max(worst, (left - Vec3(-right.x(), right.y(), right.z())).norm());
      }
  EXPECT_LT(worst, 0.005);
}

TEST(Drape, finer_meshes_agree_with_coarser_ones) {
  SewingOptions o;
  const Drape coarse = dress(scene::vest(), {0.05}, o), fine = dress(scene::vest(), {0.05, 0.025}, o);
  auto hem = [](const Drape& d) {
    double y = 9;
    for (const auto& panel : d.positions)
      for (const Vec3& p : panel) y = std::min(y, p.y());
    return y;
  };
  EXPECT_NEAR(hem(coarse), hem(fine), 0.02);
  EXPECT_LT(fine.levels.back().change_mean_mm, 15);
}

TEST(Drape, the_error_estimate_falls_from_level_to_level_and_covers_half_of_what_the_next_one_changes) {
  const Drape draft = dress(scene::vest(), {0.05}), standard = dress(scene::vest(), {0.05, 0.025}),
              fine = dress(scene::vest(), {0.05, 0.025, 0.0125});
  ASSERT_TRUE(draft.error_estimate_mm && standard.error_estimate_mm && fine.error_estimate_mm);
  EXPECT_GT(*draft.error_estimate_mm, 0.5 * standard.levels.back().change_surface_mm);
  EXPECT_GT(*standard.error_estimate_mm, 0.5 * fine.levels.back().change_surface_mm);
  EXPECT_LT(*standard.error_estimate_mm, *draft.error_estimate_mm);
  EXPECT_LT(*fine.error_estimate_mm, *standard.error_estimate_mm);
}

TEST(Drape, stiffness_that_the_cap_took_off_is_given_back_at_rest_when_asked) {
  Fabric stiff = scene::cotton();
  stiff.stretch *= 100;
  stiff.shear *= 100;
  SewingOptions o;
  const Drape capped = dress(scene::vest(), {0.05}, o, stiff);
  o.uncapped_at_rest = true;
  const Drape given = dress(scene::vest(), {0.05}, o, stiff);
  ASSERT_GT(capped.stiffness_cap, 0);
  EXPECT_EQ(given.status, "OK") << given.detail;
  EXPECT_LT(given.stretch_p99, capped.stretch_p99);
  double moved = 0, most = 0;
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t i = 0; i < given.positions[p].size(); ++i) {
      moved += (given.positions[p][i] - capped.positions[p][i]).norm();
      most += 1;
    }
  EXPECT_GT(moved / most, 1e-6);
  EXPECT_LT(moved / most, 0.02) << "it started over";
}

TEST(Drape, progress_reports_level_iteration_and_residual) {
  SewingOptions o;
  o.residual = 1e-2;
  int calls = 0;
  o.progress = [&](int level, int iteration, double residual) {
    ++calls;
    EXPECT_EQ(level, 0);
    EXPECT_GE(iteration, 0);
    EXPECT_TRUE(std::isfinite(residual));
  };
  dress(scene::vest(), {0.07}, o);
  EXPECT_GT(calls, 1);
}

TEST(Drape, a_skirt_wider_than_the_hips_is_not_supported) {
  SewingOptions o;
  const Drape d = dress(scene::skirt(0.62), {0.06, 0.05}, o);
  EXPECT_EQ(d.status, "NOT_SUPPORTED");
  EXPECT_FALSE(d.detail.empty());
  EXPECT_TRUE(finite(d));
  EXPECT_EQ(d.positions[0].size(), scene::make_pattern(scene::skirt(0.62), 0.05).meshes[0].nodes.size());
}

TEST(Drape, a_garment_too_small_for_the_body_is_returned_with_a_status) {
  scene::Outline o = scene::skirt(0.12);
  const Drape d = dress(o, {0.05});
  EXPECT_TRUE(finite(d));
  EXPECT_FALSE(d.detail.empty());
}

bool lists(const std::vector<std::string>& effects, const std::string& words) {
  return std::any_of(effects.begin(), effects.end(),
                     [&](const std::string& effect) { return effect.find(words) != std::string::npos; });
}

/// A flat ring of cloth of the given half width and height, sewn at both ends.
scene::Outline cuff(double half_width, double half_height) {
  const auto straight = [](const Vec2& a, const Vec2& b, int seam) {
    return scene::Outline::Edge{a, a + (b - a) / 3, b - (b - a) / 3, b, seam};
  };
  const Vec2 a(-half_width, -half_height), b(half_width, -half_height), c(half_width, half_height),
      d(-half_width, half_height);
  scene::Outline ring;
  ring.edges = {straight(a, b, -1), straight(b, c, 0), straight(c, d, -1), straight(d, a, 1)};
  return ring;
}

TEST(Drape, contact_between_nodes_is_modelled_where_the_body_turns_under_long_edges) {
  // A cuff of eight edges around a limb of one and a half times its girth: stretched, an edge's middle sags by more
  // than the offset.
  const DistanceField limb = scene::make_field({-0.2, -0.3, -0.2}, {0.2, 0.3, 0.2}, 0.005,
                                               [](const Vec3& p) { return std::hypot(p.x(), p.z()) - 0.035; });
  const std::vector<Pattern> levels{scene::make_pattern(cuff(0.04, 0.05), 0.0205)};
  const Drape drape =
      must(sew_and_drape(levels, scene::place_flat(levels.front(), 0.06), scene::cotton(), limb, SewingOptions{}));
  EXPECT_EQ(drape.status, "OK") << drape.detail;
  EXPECT_LT(drape.penetration_mm_max, 0.5);
  EXPECT_TRUE(lists(drape.modelled, "places where the body turns under them"));
}

TEST(Drape, contact_between_nodes_is_turned_on_everywhere_where_cloth_cut_into_the_body) {
  // Blades along the limb, thinner than an edge is long: the nodes beside them do not see the surface turn.
  int turned_on = 0;
  for (const double tip : {0.060, 0.062, 0.064, 0.066}) {
    const DistanceField limb = scene::make_field({-0.2, -0.3, -0.2}, {0.2, 0.3, 0.2}, 0.0025, [&](const Vec3& p) {
      const double blade = std::hypot(p.x(), std::max(0.0, p.z() - tip)) - 0.004;
      return std::min(std::hypot(p.x(), p.z()) - 0.05, p.z() > 0 ? blade : 1.0);
    });
    const std::vector<Pattern> levels{scene::make_pattern(cuff(0.082, 0.06), 0.03)};
    const Drape drape =
        must(sew_and_drape(levels, scene::place_flat(levels.front(), 0.08), scene::cotton(), limb, SewingOptions{}));
    turned_on += lists(drape.modelled, "at first they cut into the body");
    EXPECT_LT(drape.penetration_mm_max, 2) << tip;
    EXPECT_EQ(drape.status, drape.penetration_mm_max > 0.5 ? "INSIDE_BODY" : "OK") << tip;
  }
  EXPECT_GT(turned_on, 0);
}

TEST(Drape, a_small_budget_ends_not_converged_with_the_residual) {
  SewingOptions o;
  o.max_iterations = 30;
  const Drape d = dress(scene::vest(), {0.05}, o);
  EXPECT_EQ(d.status, "NOT_CONVERGED");
  EXPECT_GT(d.residual, o.residual);
  EXPECT_TRUE(finite(d));
}

TEST(Drape, every_stiffness_and_mass_ends_finite_or_with_an_error) {
  const auto levels = levels_of(scene::vest(), {0.09});
  const Placed placed = scene::place_flat(levels.front(), 0.16);
  SewingOptions o;
  o.residual = 1e-2;
  o.max_iterations = 4000;
  for (const double k : {1e-2, 1.0, 1e2, 1e4, 1e7})
    for (const double m : {1e-6, 1e-3, 0.1, 1.0})
      for (const double bend : {0.0, 1e-5}) {
        Fabric f = scene::cotton();
        f.stretch = k;
        f.shear = 0.3 * k;
        f.mass = m;
        f.bend = bend;
        const auto r = sew_and_drape(levels, placed, f, scene::woman(), o);
        if (!r) {
          EXPECT_EQ(r.error().code, "FABRIC_TOO_SOFT") << "k " << k << " m " << m;
          EXPECT_GT(m * 9.81 * 0.63, k);
          continue;
        }
        EXPECT_TRUE(finite(*r)) << "k " << k << " m " << m;
        EXPECT_TRUE(std::isfinite(r->residual));
        EXPECT_FALSE(r->status.empty());
      }
}

TEST(Drape, raw_constants_of_an_equilateral_mesh_are_those_of_the_sheet) {
  // One k for every spring and one m for every node, as in the paper; what they come to as a sheet is the fabric.
  Fabric sheet = scene::cotton(), ignored = sheet;
  sheet.stretch = sheet.shear = 500 * 2 / std::sqrt(3.0);
  ignored.stretch = ignored.shear = 7;
  SewingOptions o;
  o.residual = 1e-3;
  o.max_weight_strain = 0;
  SewingOptions raw = o;
  raw.spring_k = 500;
  const Drape a = dress(scene::vest(), {0.05}, o, sheet), b = dress(scene::vest(), {0.05}, raw, ignored);
  EXPECT_EQ(a.status, "OK");
  EXPECT_EQ(b.status, "OK") << b.detail;
  double sum = 0, most = 0;
  for (std::size_t i = 0; i < a.positions[0].size(); ++i) {
    const double moved = (a.positions[0][i] - b.positions[0][i]).norm();
    sum += moved;
    most = std::max(most, moved);
  }
  EXPECT_GT(most, 0);  // the mesh is not quite equilateral
  EXPECT_LT(sum / static_cast<double>(a.positions[0].size()), 0.01);
  EXPECT_TRUE(lists(b.modelled, "springs of one k each"));
  raw.node_mass = 1e3;
  const auto levels = levels_of(scene::vest(), {0.05});
  const auto heavy = sew_and_drape(levels, scene::place_flat(levels[0], 0.16), ignored, scene::woman(), raw);
  ASSERT_FALSE(heavy);
  EXPECT_EQ(heavy.error().code, "FABRIC_TOO_SOFT");
}

TEST(Drape, any_friction_ends_with_a_status) {
  for (const double mu : {0.0, 1.0, 100.0}) {
    Fabric f = scene::cotton();
    f.friction = mu;
    const Drape d = dress(scene::vest(), {0.05}, {}, f);
    EXPECT_EQ(d.status, "OK") << mu << ": " << d.detail;
  }
}

TEST(Drape, a_residual_below_rounding_ends_before_the_budget_and_is_named) {
  SewingOptions o;
  o.residual = 1e-18;
  o.friction = false;
  const Drape d = dress(scene::vest(), {0.09}, o);
  EXPECT_EQ(d.status, "NOT_CONVERGED");
  EXPECT_LT(d.residual, 1e-7);
  EXPECT_LT(d.levels.back().iterations, o.max_iterations);
}

TEST(Drape, panels_both_before_the_body_fall_off_and_are_said_to) {
  const auto levels = levels_of(scene::vest(), {0.06});
  Placed placed = scene::place_flat(levels[0], 0.16);
  for (Vec3& p : placed[1]) p.z() = 0.2;
  const Drape d = must(sew_and_drape(levels, placed, scene::cotton(), scene::woman(), {}));
  EXPECT_TRUE(finite(d));
  EXPECT_EQ(d.status, "NOT_SUPPORTED");
  EXPECT_FALSE(d.detail.empty());
}

TEST(Drape, panels_turned_on_their_side_end_with_a_status) {
  const auto levels = levels_of(scene::vest(), {0.06});
  Placed turned = scene::place_flat(levels[0], 0.16);
  for (auto& panel : turned)
    for (Vec3& p : panel) p = Vec3(p.y() - 1.2, 1.2 - p.x(), p.z());
  const Drape d = must(sew_and_drape(levels, turned, scene::cotton(), scene::woman(), {}));
  EXPECT_TRUE(finite(d));
  EXPECT_TRUE(d.status == "OK" || !d.detail.empty()) << d.status;
}

TEST(Drape, a_hundredfold_gravity_is_carried_or_named) {
  SewingOptions o;
  o.gravity = 981;
  const Drape d = dress(scene::vest(), {0.06}, o);
  EXPECT_TRUE(finite(d));
  EXPECT_TRUE(d.status == "OK" || !d.detail.empty());
}

TEST(Drape, weightless_cloth_and_missing_gravity_come_to_rest) {
  Fabric f = scene::cotton();
  f.mass = 0;
  SewingOptions o;
  o.residual = 1e-2;
  o.max_iterations = 5000;
  EXPECT_TRUE(finite(dress(scene::vest(), {0.08}, o, f)));
  o.gravity = 0;
  EXPECT_TRUE(finite(dress(scene::vest(), {0.08}, o)));
}

TEST(Drape, needle_triangles_and_coincident_nodes_do_no_harm) {
  auto levels = levels_of(scene::vest(), {0.08});
  for (PanelMesh& m : levels[0].meshes) {
    const Triangle t = m.triangles.front();
    m.nodes.push_back(m.nodes[t[0]]);  // a double of a corner
    const auto twin = static_cast<std::uint32_t>(m.nodes.size() - 1);
    m.triangles.push_back({t[0], twin, t[1]});
    m.nodes.push_back(0.5 * (m.nodes[t[0]] + m.nodes[t[1]]) + Vec2(0, 1e-7));
    m.triangles.push_back({t[0], t[1], twin + 1});
  }
  SewingOptions o;
  o.residual = 1e-2;
  o.max_iterations = 3000;
  const Drape d = must(sew_and_drape(levels, scene::place_flat(levels[0], 0.16), scene::cotton(), scene::woman(), o));
  EXPECT_TRUE(finite(d));
}

TEST(Drape, panels_that_start_inside_the_body_come_out_on_their_own_side) {
  const auto levels = levels_of(scene::vest(), {0.05});
  const Drape d = must(sew_and_drape(levels, scene::place_flat(levels[0], 0.03), scene::cotton(), scene::woman(), {}));
  EXPECT_LE(d.penetration_mm_max, 2);
  for (std::size_t i = 0; i < d.positions[0].size(); ++i) {
    const Vec2 q = levels[0].meshes[0].nodes[i];
    if (std::abs(q.x()) > 0.1 || q.y() > 1.3) continue;
    EXPECT_GT(d.positions[0][i].z(), 0);
    EXPECT_LT(d.positions[1][i].z(), 0);
  }
}

}  // namespace
}  // namespace vitrine
