// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes whose rest shape is known on paper: the springs and the relaxation have to find it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "cloth.hpp"
#include "contact.hpp"
#include "prolong.hpp"
#include "relax.hpp"
#include "residual.hpp"
#include "scene.hpp"
#include "smooth_field.hpp"
#include "springs.hpp"

namespace vitrine {
namespace {

using namespace sewing;

using scene::g;

/// A chain of n equal springs, hung on its first node: no mesh, only the arrays.
Cloth chain(int n, double k, double mass, double rest) {
  Cloth c;
  c.size = n + 1;
  c.gravity = g;
  for (int i = 0; i <= n; ++i) {
    c.x.insert(c.x.end(), {0.0, -rest * i, 0.0});
    c.mass.push_back(i == 0 ? 0 : mass);
    c.pinned.push_back(i == 0);
    c.weight += c.mass.back() * g;
    if (i == 0) continue;
    c.edge_a.push_back(i - 1);
    c.edge_b.push_back(i);
    c.edge_k.push_back(k);
    c.edge_rest.push_back(rest);
  }
  c.scale = c.weight;
  c.side.assign(c.size, 0);
  c.area.assign(c.size, 0);
  return c;
}

RelaxOptions to(double residual, double friction = 0) {
  RelaxOptions o;
  o.residual = residual;
  o.max_iterations = 200'000;
  o.friction = friction;
  return o;
}

Pattern two_panels(const PanelMesh& mesh) {
  Pattern p;
  p.meshes = {mesh, mesh};
  p.panels.resize(2);
  return p;
}

/// The front panel of `mesh` alone, hung in the plane z = 0.
Cloth sheet(const PanelMesh& mesh, const SheetStiffness& s, double density, Nodes& nodes) {
  Pattern p = two_panels(mesh);
  p.meshes.resize(1);
  int count = 0;
  nodes = number_nodes(p, {}, count);
  Positions x(1);
  for (const Vec2& q : mesh.nodes) x[0].push_back({q.x(), q.y(), 0});
  return build_cloth(p, nodes, count, x, s, density, g, s.bend > 0);
}

TEST(Relaxation, every_spring_of_a_hanging_chain_bears_the_weight_below_it) {
  // Paper eq. (2): k dl_i = sum of the weights below.
  const int n = 100;
  const double k = 100, m = 1e-3;
  Cloth c = chain(n, k, m, 0.01);
  const auto done = relax(c, nullptr, to(1e-7));
  ASSERT_TRUE(done.converged);
  EXPECT_NEAR(-c.x[3 * n + 1] - 0.01 * n, m * g * n * (n + 1) / (2 * k), 1e-6 * 0.4954);
  for (int i = 1; i <= n; ++i) {
    const double stretch = c.x[3 * (i - 1) + 1] - c.x[3 * i + 1] - 0.01;
    EXPECT_NEAR(k * stretch, m * g * (n + 1 - i), 1e-6 * m * g * n) << "spring " << i;
  }
}

TEST(Relaxation, an_elastic_cable_sags_as_the_catenary_formula_says) {
  // Length 1 m, span 0.8 m, weight 2 N, EA = 50 N: sag 0.278248 m.
  for (const auto& [n, bound] : {std::pair{20, 2e-3}, std::pair{80, 1.5e-4}}) {
    Cloth c = chain(n, 50.0 * n, 2.0 / g / n, 1.0 / n);
    for (int i = 0; i <= n; ++i) {
      c.x[3 * i] = 0.8 * i / n;
      c.x[3 * i + 1] = -0.2 * std::sin(3.14159 * i / n);
    }
    c.pinned[n] = 1;
    ASSERT_TRUE(relax(c, nullptr, to(1e-6)).converged);
    EXPECT_NEAR(-c.x[3 * (n / 2) + 1], 0.278248, bound * 0.278248) << n << " springs";
  }
}

TEST(Cloth, a_strip_hung_from_an_edge_stretches_by_its_weight_over_k_at_every_mesh_size) {
  // Without shear stiffness the columns are independent: extension = rho g H^2 / 2K, whatever the mesh.
  const double stiffness = 500, density = 0.5, height = 0.6;
  for (const int rows : {6, 12, 24}) {
    const PanelMesh mesh = scene::grid_mesh(0.2, height, rows / 3, rows, {0, 0});
    Nodes nodes;
    Cloth c = sheet(mesh, {stiffness, 0, 0}, density, nodes);
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) c.pinned[nodes[0][i]] = mesh.nodes[i].y() > height - 1e-9;
    ASSERT_TRUE(relax(c, nullptr, to(1e-6)).converged);
    const double exact = density * g * height * height / (2 * stiffness);
    double lowest = 0;
    for (int n = 0; n < c.size; ++n) lowest = std::min(lowest, c.x[3 * n + 1]);
    // Border columns have the right weight per stiffness too: both are halved there.
    EXPECT_NEAR(-lowest, exact, 0.02 * exact) << rows << " rows";
  }
}

TEST(Cloth, an_equilateral_mesh_has_young_modulus_k) {
  // Uniaxial pull of a hexagonal mesh: forces at the ends over width = K * strain, Poisson's ratio 1/3.
  const double stiffness = 1000, h = 0.02, strain = 0.01;
  PanelMesh mesh;
  const int columns = 30, rows = 30;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) mesh.nodes.push_back({(i + (j % 2) * 0.5) * h, j * h * std::sqrt(0.75)});
  auto id = [&](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      if (j % 2 == 0) {
        mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i, j + 1)});
        mesh.triangles.push_back({id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
      } else {
        mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
        mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
      }
    }
  Nodes nodes;
  Cloth c = sheet(mesh, {stiffness, stiffness, 0}, 0.0, nodes);
  // A uniform strain field with the transverse contraction of nu = 1/3.
  for (int n = 0; n < c.size; ++n) {
    c.x[3 * n] *= 1 - strain / 3;
    c.x[3 * n + 1] *= 1 + strain;
  }
  std::vector<double> force(c.x.size(), 0.0);
  internal_forces(c, c.x, force);
  double pull = 0;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (mesh.nodes[i].y() > rows * h * std::sqrt(0.75) - 1e-9) pull -= force[3 * nodes[0][i] + 1];
  EXPECT_NEAR(pull / (columns * h), stiffness * strain, 0.03 * stiffness * strain);
}

TEST(Cloth, forces_are_the_slope_of_the_energy) {
  const PanelMesh mesh = scene::grid_mesh(0.2, 0.2, 4, 4, {0, 0});
  Nodes nodes;
  Cloth c = sheet(mesh, {800, 200, 1e-3}, 0.2, nodes);
  c.seams.push_back({0, 12, 50, 100});
  c.seams.push_back({3, 20, 50, 0.5});
  std::mt19937 random(7);
  for (double& v : c.x) v += 0.01 * (static_cast<double>(random() >> 8) / (1 << 24) - 0.5);
  std::vector<double> force(c.x.size(), 0.0), ignored(c.x.size(), 0.0);
  internal_forces(c, c.x, force);
  const double h = 1e-6;
  for (std::size_t i = 0; i < c.x.size(); ++i) {
    std::vector<double> x = c.x;
    x[i] += h;
    const double up = internal_forces(c, x, ignored);
    x[i] -= 2 * h;
    const double down = internal_forces(c, x, ignored);
    EXPECT_NEAR(force[i], -(up - down) / (2 * h), 1e-5 * 800);
  }
}

TEST(Cloth, bending_costs_what_a_cylinder_costs) {
  // E = B/2 * curvature^2 * area.
  const double bend = 1e-3, radius = 0.5;
  const PanelMesh mesh = scene::grid_mesh(0.4, 0.4, 32, 32, {0, 0});
  Nodes nodes;
  Cloth c = sheet(mesh, {0, 0, bend}, 0.0, nodes);
  for (int n = 0; n < c.size; ++n) {
    const double a = c.x[3 * n] / radius;
    c.x[3 * n] = radius * std::sin(a);
    c.x[3 * n + 2] = radius * (1 - std::cos(a));
  }
  std::vector<double> force(c.x.size(), 0.0);
  const double exact = 0.5 * bend / (radius * radius) * 0.16;
  EXPECT_NEAR(internal_forces(c, c.x, force), exact, 0.08 * exact);
}

TEST(Cloth, bends_ten_times_as_stiffly_within_two_centimetres_of_an_open_edge_and_only_there) {
  const Pattern hemmed = scene::make_pattern(scene::skirt(), 0.012);
  Pattern raw = hemmed;
  for (Panel& panel : raw.panels) panel.outline.clear();
  const std::vector<char> sewn(hemmed.pairs.size(), 1);
  int count = 0;
  const Nodes nodes = number_nodes(hemmed, sewn, count);
  const Positions flat = scene::place_flat(hemmed, 0);
  const auto cloth = [&](const Pattern& p) {
    return build_cloth(p, nodes, count, flat, {1000, 300, 1e-5}, 0.2, 9.81, true);
  };
  const Cloth with = cloth(hemmed), without = cloth(raw);
  ASSERT_EQ(with.hinge_k.size(), without.hinge_k.size());
  double bottom = 9, top = 0;
  for (const Vec2& q : hemmed.meshes[0].nodes) bottom = std::min(bottom, q.y()), top = std::max(top, q.y());
  int stiff = 0;
  for (std::size_t h = 0; h < with.hinge_k.size(); ++h) {
    const double y = (with.at(with.hinge[4 * h]).y() + with.at(with.hinge[4 * h + 1]).y()) / 2;
    const double edge = std::min(y - bottom, top - y), ratio = with.hinge_k[h] / without.hinge_k[h];
    EXPECT_TRUE(std::abs(ratio - 1) < 1e-9 || std::abs(ratio - 10) < 1e-9) << ratio;
    if (edge > 0.05) {  // the outline's curve at hem and waist takes some
      EXPECT_NEAR(ratio, 1, 1e-9) << edge;
    }
    stiff += ratio > 5;
  }
  EXPECT_GT(stiff, 100);
}

TEST(Cloth, bias_is_softer_than_warp) {
  PanelMesh mesh;
  mesh.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  Nodes nodes;
  const Cloth c = sheet(mesh, {1000, 100, 0}, 0.1, nodes);
  ASSERT_EQ(c.edge_k.size(), 5u);
  for (std::size_t e = 0; e < 5; ++e) {
    const bool diagonal = c.edge_rest[e] > 1.1;
    EXPECT_NEAR(c.edge_k[e] * c.edge_rest[e] * c.edge_rest[e], diagonal ? 100 * 1.0 : 1000 * 0.5, 1e-9);
  }
}

TEST(Cloth, edges_buckle_at_eulers_load_and_keep_a_tenth_of_their_stiffness) {
  PanelMesh mesh;
  mesh.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  Nodes nodes;
  const double bend = 15;  // [N m] no panel has an outline here, so none of it is a band
  Cloth c = sheet(mesh, {1000, 100, bend}, 0, nodes);
  ASSERT_EQ(c.edge_buckles.size(), c.edge_k.size());
  for (std::size_t e = 0; e < c.edge_k.size(); ++e) {
    const double length = c.edge_rest[e], width = (length > 1.1 ? 1.0 : 0.5) / length;
    const double load = std::numbers::pi * std::numbers::pi * bend * width / (length * length);
    EXPECT_NEAR(c.edge_k[e] * c.edge_buckles[e], load, 1e-9 * load);
  }
  // One edge alone, pressed: the load at which it buckles, and a tenth of the slope from there on.
  for (std::size_t e = 1; e < c.edge_k.size(); ++e) c.edge_k[e] = 0;
  c.hinge.clear(), c.hinge_k.clear(), c.hinge_c.clear();
  const Vec3 a = c.at(c.edge_a[0]), along = (c.at(c.edge_b[0]) - a).normalized();
  for (const double shorter : {-0.1, 0.5 * c.edge_buckles[0], c.edge_buckles[0], c.edge_buckles[0] + 0.1}) {
    const Vec3 b = a + (c.edge_rest[0] - shorter) * along;
    std::copy_n(b.data(), 3, &c.x[3 * c.edge_b[0]]);
    std::vector<double> force(c.x.size(), 0.0), unused(c.x.size(), 0.0);
    const double energy = internal_forces(c, c.x, force);
    const double push = force[3 * c.edge_b[0]] * along.x() + force[3 * c.edge_b[0] + 1] * along.y();
    const double past = std::max(0.0, shorter - c.edge_buckles[0]);
    EXPECT_NEAR(push, c.edge_k[0] * (shorter - 0.9 * past), 1e-9);
    std::vector<double> nearer = c.x;
    for (int i = 0; i < 3; ++i) nearer[3 * c.edge_b[0] + i] -= 1e-7 * along[i];
    EXPECT_NEAR((internal_forces(c, nearer, unused) - energy) / 1e-7, push, 1e-4 * std::max(1.0, std::abs(push)));
    Packed x, packed;
    pack(c.x, x);
    packed.assign(x.size(), 0.0);
    EXPECT_NEAR(Springs(c).forces(x, packed), energy, 1e-12);
    std::vector<double> wide(c.x.size());
    unpack(packed, wide);
    for (std::size_t i = 0; i < wide.size(); ++i) EXPECT_NEAR(wide[i], force[i], 1e-9);
  }
}

TEST(Cloth, the_papers_springs_never_buckle) {
  PanelMesh mesh = scene::grid_mesh(0.4, 0.4, 4, 4, {0, 0});
  Nodes nodes;
  Cloth c = sheet(mesh, {1000, 100, 1e-5}, 0.2, nodes);
  EXPECT_FALSE(c.edge_buckles.empty());
  set_raw_constants(c, 25, 0);
  EXPECT_TRUE(c.edge_buckles.empty());
}

TEST(Relaxation, a_falling_residual_ends_below_the_start_energy) {
  const PanelMesh mesh = scene::grid_mesh(0.4, 0.4, 12, 12, {0, 0});
  Nodes nodes;
  Cloth c = sheet(mesh, {1000, 300, 1e-5}, 0.2, nodes);
  for (int n = 0; n < c.size; ++n) std::swap(c.x[3 * n + 1], c.x[3 * n + 2]);
  c.pinned[nodes[0][0]] = c.pinned[nodes[0][12]] = 1;
  std::vector<double> force(c.x.size(), 0.0);
  const double before = internal_forces(c, c.x, force);
  const auto done = relax(c, nullptr, to(1e-3));
  ASSERT_TRUE(done.converged);
  EXPECT_LT(done.energy, before);
  EXPECT_NEAR(residual_of(c, nullptr, 0), done.residual, 1e-6);
}

/// A small cloth on a slope of `angle`; returns how far it slid.
double slide(double angle, double mu, bool& converged) {
  const Vec3 up(std::sin(angle), std::cos(angle), 0);  // falls towards +x
  const DistanceField slope =
      scene::make_field({-1, -1, -1}, {3, 1, 1}, 0.05, [&](const Vec3& p) { return p.dot(up); });
  const PanelMesh mesh = scene::grid_mesh(0.1, 0.1, 5, 5, {0, 0});
  Nodes nodes;
  Cloth c = sheet(mesh, {1000, 300, 0}, 0.2, nodes);
  const Vec3 down(std::cos(angle), -std::sin(angle), 0);
  for (int n = 0; n < c.size; ++n) {
    const Vec3 p = down * c.x[3 * n] + Vec3(0, 0, c.x[3 * n + 1]) + 0.004 * up;
    for (int a = 0; a < 3; ++a) c.x[3 * n + a] = p[a];
  }
  const double start = c.x[0];
  Contact contact = make_contact(c, slope, 0.004, 1e-3, 1000);
  RelaxOptions o = to(1e-4, mu);
  o.max_iterations = 12'000;
  converged = relax(c, &contact, o).converged;
  return std::abs(c.x[0] - start);
}

TEST(Friction, cloth_sticks_to_a_slope_just_below_the_friction_angle_and_slides_just_above) {
  const double angle = 0.4;
  bool rests = false;
  EXPECT_LT(slide(angle, 1.05 * std::tan(angle), rests), 0.002);
  EXPECT_TRUE(rests);
  EXPECT_GT(slide(angle, 0.95 * std::tan(angle), rests), 0.05);
  EXPECT_FALSE(rests);
}

TEST(SmoothField, is_exact_for_planes_and_its_gradient_is_its_slope) {
  const DistanceField plane =
      scene::make_field({0, 0, 0}, {1, 1, 1}, 0.1, [](const Vec3& p) { return 0.6 * p.x() - 0.8 * p.y() + 0.1; });
  const DistanceField ball =
      scene::make_field({-1, -1, -1}, {1, 1, 1}, 0.1, [](const Vec3& p) { return p.norm() - 0.5; });
  std::mt19937 random(3);
  auto unit = [&] { return static_cast<double>(random() >> 8) / (1 << 24); };
  for (int i = 0; i < 200; ++i) {
    Vec3 p(unit(), unit(), unit()), gradient, ignored;
    EXPECT_NEAR(smooth_distance(plane, p, gradient), 0.6 * p.x() - 0.8 * p.y() + 0.1, 1e-6);
    if ((p.array() > 0.05 && p.array() < 0.85).all()) {
      EXPECT_LT((gradient - Vec3(0.6, -0.8, 0)).norm(), 1e-5);
    }
    p = 1.6 * p - Vec3(0.8, 0.8, 0.8);
    smooth_distance(ball, p, gradient);
    for (int a = 0; a < 3; ++a) {
      const Vec3 h = 1e-5 * Vec3::Unit(a);
      EXPECT_NEAR(gradient[a], (smooth_distance(ball, p + h, ignored) - smooth_distance(ball, p - h, ignored)) / 2e-5,
                  1e-4);
    }
  }
}

TEST(Prolongation, a_linear_shape_is_kept_and_continued_past_the_border) {
  const PanelMesh coarse = scene::grid_mesh(1, 1, 4, 4, {0, 0}),
                  fine = scene::grid_mesh(1.04, 1.04, 9, 9, {-0.02, -0.02});
  auto shape = [](const Vec2& p) { return Vec3(1 + p.x(), 2 * p.y(), 3 - p.x() + p.y()); };
  std::vector<Vec3> x;
  for (const Vec2& p : coarse.nodes) x.push_back(shape(p));
  const auto out = prolong(coarse, x, fine);
  ASSERT_EQ(out.size(), fine.nodes.size());
  for (std::size_t i = 0; i < out.size(); ++i) EXPECT_LT((out[i] - shape(fine.nodes[i])).norm(), 1e-9);
}

TEST(Welding, shared_corners_become_one_node_whatever_the_order_of_the_pairs) {
  Pattern p = two_panels(scene::grid_mesh(1, 1, 2, 2, {0, 0}));
  p.pairs = {{0, 0, 1, 0, 0}, {0, 2, 1, 2, 1}, {0, 0, 0, 2, 2}, {0, 6, 1, 6, 0}};
  const std::vector<char> all(p.pairs.size(), 1);
  int count = 0, count_back = 0;
  const Nodes nodes = number_nodes(p, all, count);
  EXPECT_EQ(count, 18 - 4);
  EXPECT_EQ(nodes[0][0], nodes[1][2]);
  std::reverse(p.pairs.begin(), p.pairs.end());
  EXPECT_EQ(number_nodes(p, all, count_back), nodes);
}

}  // namespace
}  // namespace vitrine
