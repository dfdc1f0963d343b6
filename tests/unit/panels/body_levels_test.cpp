// SPDX-License-Identifier: GPL-3.0-or-later
#include "../../../engine/panels/body_levels.hpp"

#include <gtest/gtest.h>

using namespace vitrine;
using panels_room::scale_for_body;

namespace {

/// A straight skirt, 100 px wide and 140 px long, its waist at y = 0.
const std::vector<Vec2> straight{{0, 0}, {100, 0}, {100, 140}, {0, 140}};

}  // namespace

TEST(BodyLevels, a_straight_skirt_grows_until_it_passes_the_hips) {
  const double scale = scale_for_body(0.0034, straight, 0, {{0.2, 0.94}});
  EXPECT_NEAR(100 * scale, 0.47, 1e-3);
}

TEST(BodyLevels, a_garment_that_is_wide_enough_keeps_its_scale) {
  EXPECT_DOUBLE_EQ(scale_for_body(0.0050, straight, 0, {{0.2, 0.94}}), 0.0050);
}

TEST(BodyLevels, levels_that_the_garment_does_not_reach_or_that_lie_above_it_do_not_matter) {
  EXPECT_DOUBLE_EQ(scale_for_body(0.0034, straight, 0, {{0.9, 0.94}, {-0.2, 0.94}}), 0.0034);
}

TEST(BodyLevels, growth_is_bounded) {
  EXPECT_NEAR(scale_for_body(0.0034, straight, 0, {{0.2, 9.4}}), 0.0051, 1e-9);
}
