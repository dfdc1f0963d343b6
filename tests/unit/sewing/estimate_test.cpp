// SPDX-License-Identifier: GPL-3.0-or-later
// What the error estimate looks at, on shapes whose figures are known.
#include "estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scene.hpp"

namespace vitrine {
namespace {

using namespace sewing;

constexpr double offset = 0.004;

/// A floor at y = 0.
const DistanceField& floor_field() {
  static const DistanceField field =
      scene::make_field({-0.5, -0.1, -0.5}, {0.5, 0.5, 0.5}, 0.02, [](const Vec3& p) { return p.y(); });
  return field;
}

Pattern sheets(int cells) {
  Pattern pattern;
  const PanelMesh mesh = scene::grid_mesh(0.3, 0.3, cells, cells, {0, 0});
  pattern.meshes = {mesh, mesh};
  return pattern;
}

/// Both panels lie on the same surface over the floor: `height` as a function of the rest place.
template <class Height>
Positions laid(const Pattern& pattern, Height&& height) {
  Positions x(2);
  for (std::size_t p = 0; p < 2; ++p)
    for (const Vec2& q : pattern.meshes[p].nodes) x[p].emplace_back(q.x() - 0.15, height(q.x()), q.y() - 0.15);
  return x;
}

TEST(Estimate, flat_cloth_turns_nowhere_and_its_gap_is_its_height_over_the_offset) {
  const Pattern pattern = sheets(10);
  const Positions x = laid(pattern, [](double) { return 0.124; });
  EXPECT_NEAR(loose_turn(pattern, x, floor_field(), offset), 0, 1e-9);
  EXPECT_NEAR(mean_gap(pattern, x, floor_field(), offset), 0.12, 1e-6);
  EXPECT_NEAR(estimate_error({}), 0, 1e-12);
}

TEST(Estimate, waves_turn_half_as_much_at_an_edge_of_half_the_length) {
  const auto wave = [](double x) { return 0.2 + 0.01 * std::sin(40 * x); };
  const Pattern coarse = sheets(20), fine = sheets(40);
  const double a = loose_turn(coarse, laid(coarse, wave), floor_field(), offset),
               b = loose_turn(fine, laid(fine, wave), floor_field(), offset);
  EXPECT_GT(a, 0.02);
  EXPECT_NEAR(b / a, 0.5, 0.05);
}

TEST(Estimate, waves_that_the_body_holds_count_as_flat) {
  const Pattern pattern = sheets(20);
  EXPECT_EQ(loose_turn(pattern, laid(pattern, [](double x) { return 0.007 + 0.005 * std::sin(40 * x); }), floor_field(),
                       offset),
            0);
}

TEST(Estimate, cloth_that_the_body_holds_everywhere_is_still_off_by_a_share_of_the_edges) {
  LevelFigures held;
  held.edge_mm = 20;
  EXPECT_GT(estimate_error(held), 0.1);
  LevelFigures finer = held;
  finer.edge_mm = 10;
  EXPECT_NEAR(estimate_error(finer) / estimate_error(held), 0.5, 1e-9);
}

TEST(Estimate, grows_with_the_turn_and_with_how_far_off_the_body_the_folds_are) {
  LevelFigures tight, folded, flared;
  tight.loose_turn = 0.01, tight.gap_mm = 5;
  folded.loose_turn = 0.02, folded.gap_mm = 5;
  flared.loose_turn = 0.02, flared.gap_mm = 60;
  EXPECT_NEAR(estimate_error(folded) / estimate_error(tight), 2, 1e-9);
  EXPECT_GT(estimate_error(flared), 2 * estimate_error(folded));
}

}  // namespace
}  // namespace vitrine
