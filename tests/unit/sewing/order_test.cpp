// SPDX-License-Identifier: GPL-3.0-or-later
// Chains between pins and from a clamp: second order in the spacing, and what they tend to is the formula's.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cloth.hpp"
#include "relax.hpp"
#include "scene.hpp"

namespace vitrine {
namespace {

using namespace sewing;

using scene::g;

void add_node(Cloth& c, double x, double y, double mass, bool pinned) {
  c.x.insert(c.x.end(), {x, y, 0.0});
  c.mass.push_back(mass);
  c.pinned.push_back(pinned);
  c.side.push_back(0);
  c.area.push_back(0);
  if (!pinned) c.weight += mass * g;
  c.scale = c.weight;
  c.gravity = g;
  ++c.size;
}

void add_spring(Cloth& c, int a, int b, double k, double rest) {
  c.edge_a.push_back(a);
  c.edge_b.push_back(b);
  c.edge_k.push_back(k);
  c.edge_rest.push_back(rest);
}

bool settle(Cloth& c) {
  RelaxOptions o;
  o.residual = 1e-7;
  o.max_iterations = 400'000;
  o.step_limit = 0.005;
  return relax(c, nullptr, o).converged;
}

/// Sag of a cable of length 1 m and weight 2 N over a span of 0.8 m, EA = 50 N, from n springs.
double sag(int n) {
  Cloth c;
  for (int i = 0; i <= n; ++i)
    add_node(c, 0.8 * i / n, -0.2 * std::sin(std::numbers::pi * i / n), 2.0 / g / n, i == 0 || i == n);
  for (int i = 0; i < n; ++i) add_spring(c, i, i + 1, 50.0 * n, 1.0 / n);
  EXPECT_TRUE(settle(c)) << n;
  return -c.x[3 * (n / 2) + 1];
}

TEST(Order, the_elastic_catenary_is_approached_in_second_order) {
  const double coarse = sag(20), middle = sag(40), fine = sag(80);
  EXPECT_NEAR(std::log2((coarse - middle) / (middle - fine)), 2, 0.1);
  EXPECT_NEAR((4 * fine - middle) / 3, 0.278248, 1e-5 * 0.278248);
}

/// Chord angle [degree] of a strip clamped level at 0 and bending under its own weight: weight w per length, rigidity
/// B, w L^3 / B = `load`; L is 0.1 m. The clamp lies in the middle of the first cell.
double droop(int n, double load) {
  const double length = 0.1, weight = 1, rigidity = weight * length * length * length / load, h = length / (n - 0.5);
  Cloth c;
  for (int i = 0; i <= n; ++i) add_node(c, (i - 0.5) * h, 0, weight * h / g * (i == n ? 0.5 : 1), i < 2);
  for (int i = 0; i < n; ++i) add_spring(c, i, i + 1, 1e4 * weight * length / h, h);
  for (int i = 1; i < n; ++i) {
    c.hinge.insert(c.hinge.end(), {i - 1, i, i + 1, i + 1});
    c.hinge_c.insert(c.hinge_c.end(), {1, -2, 1, 0});
    c.hinge_k.push_back(rigidity / (h * h * h));
  }
  EXPECT_TRUE(settle(c)) << n;
  return 180 / std::numbers::pi * std::atan2(-c.x[3 * n + 1], c.x[3 * n]);
}

TEST(Order, a_strip_bends_under_its_weight_as_the_heavy_elastica_does) {
  for (const auto& [load, exact] : {std::pair{1.0, 7.100}, {3.0, 20.033}, {8.0, 41.487}, {20.0, 61.786}}) {
    const double coarse = droop(20, load), fine = droop(40, load);
    EXPECT_NEAR(coarse, exact, 3) << load;
    const double ratio = (39.5 * 39.5) / (19.5 * 19.5);
    EXPECT_NEAR((ratio * fine - coarse) / (ratio - 1), exact, 0.1) << load << ": " << coarse << ' ' << fine;
  }
}

}  // namespace
}  // namespace vitrine
