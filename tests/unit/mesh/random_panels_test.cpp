// SPDX-License-Identifier: GPL-3.0-or-later
#include "validity.hpp"

namespace vitrine {
namespace {

constexpr std::uint32_t kBatch = 100;

class RandomPanels : public testing::TestWithParam<std::uint32_t> {};

TEST_P(RandomPanels, are_covered_exactly_without_a_sharp_triangle) {
  for (std::uint32_t seed = kBatch * GetParam(); seed < kBatch * (GetParam() + 1); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const test::RandomPanel panel = test::random_panel(seed);
    const auto mesh = mesh_panel(panel.outline, {.edge_length = panel.h}, panel.holes);
    ASSERT_TRUE(mesh) << mesh.error().message;
    test::expect_valid(panel.outline, *mesh, panel.holes);
    EXPECT_GE(test::smallest_angle(test::Rim(panel.outline, panel.holes), *mesh, 15), 15);
  }
}

INSTANTIATE_TEST_SUITE_P(two_thousand, RandomPanels, testing::Range(0u, 2000u / kBatch));

TEST(RandomPanels, are_what_the_test_says) {
  int holes = 0, concave = 0, narrow = 0;
  for (std::uint32_t seed = 0; seed < 2000; ++seed) {
    const test::RandomPanel panel = test::random_panel(seed);
    holes += !panel.holes.empty();
    const test::Rim rim(panel.outline, panel.holes);
    int reflex = 0;
    for (std::uint32_t i = 0; i < panel.outline.size(); ++i) reflex += rim.corner(i) > 200;
    concave += reflex > 0;
    narrow += seed % 3 == 2;
  }
  EXPECT_GT(holes, 600);
  EXPECT_GT(concave, 1200);
  EXPECT_GT(narrow, 600);
}

}  // namespace
}  // namespace vitrine
