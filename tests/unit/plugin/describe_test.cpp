// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/host/describe.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "given.hpp"
#include "mutable_garment.hpp"
#include "vitrine/host/adopt.hpp"
#include "vitrine/templates/necklines.hpp"
#include "vitrine/templates/sleeve.hpp"

namespace vitrine {
namespace {

using test::identity;
using ::testing::HasSubstr;

TEST(Describe, names_every_part_of_a_garment) {
  const auto g = adopt_garment(templates::long_sleeve, identity);
  ASSERT_TRUE(g);
  const std::string text = describe(*g), drawing = draw_svg(*g);
  for (const auto& feature : g->features) {
    EXPECT_THAT(text, HasSubstr(feature.name));
    EXPECT_THAT(drawing, HasSubstr(">" + feature.name + "</text>"));
  }
  for (const auto& edge : g->edges) EXPECT_THAT(text, HasSubstr(edge.name));
  for (const auto& fabric : g->fabrics) EXPECT_THAT(text, HasSubstr(fabric.name));
  for (const auto& pose : g->poses) {
    EXPECT_THAT(text, HasSubstr("Pose " + pose.name));
    EXPECT_THAT(drawing, HasSubstr("pose " + pose.name));
  }
  EXPECT_THAT(text, HasSubstr("shoulder_left elbow_left wrist_left"));
  EXPECT_EQ(draw_svg(*g), drawing);
}

TEST(Describe, names_the_ratio_that_selects_a_neckline) {
  vitrine_neckline table = templates::neck_u;
  table.ratio_min = 0.25, table.ratio_max = 0.75;
  const auto n = adopt_neckline(table, identity);
  ASSERT_TRUE(n);
  EXPECT_THAT(describe(*n), HasSubstr("at least 0.25 and below 0.75"));
}

TEST(DrawSvg, cannot_be_made_to_carry_markup) {
  MutableGarment m(templates::vest);
  m.table.title = "<script>alert(1)</script> & more";
  const auto g = adopt_garment(m.get(), identity);
  ASSERT_TRUE(g);
  const std::string drawing = draw_svg(*g);
  EXPECT_THAT(drawing, testing::Not(HasSubstr("<script")));
  EXPECT_THAT(drawing, HasSubstr("&lt;script&gt;"));
  EXPECT_THAT(drawing, HasSubstr("&amp; more"));
}

}  // namespace
}  // namespace vitrine
