// SPDX-License-Identifier: GPL-3.0-or-later
// A drape that may stop early: at the level that is good enough, or where its work runs out.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "scene.hpp"
#include "vitrine/sewing.hpp"

namespace vitrine {
namespace {

const std::vector<Pattern>& levels() {
  static const std::vector<Pattern> made{scene::make_pattern(scene::vest(), 0.06),
                                         scene::make_pattern(scene::vest(), 0.04),
                                         scene::make_pattern(scene::vest(), 0.025)};
  return made;
}

Drape drape(double max_error, double max_work, int* made = nullptr) {
  SewingOptions o;
  o.max_error = max_error;
  o.max_work = max_work;
  PatternLevels lazy;
  for (const Pattern& p : levels())
    lazy.nodes.push_back(static_cast<int>(p.meshes[0].nodes.size() + p.meshes[1].nodes.size()));
  lazy.at = [&](int level) -> Result<const Pattern*> {
    if (made) *made = std::max(*made, level + 1);
    return &levels()[level];
  };
  auto r = sew_and_drape(lazy, scene::place_flat(levels().front(), 0.16), scene::cotton(), scene::woman(), o);
  if (!r) ADD_FAILURE() << r.error().code << ": " << r.error().message;
  return r ? *std::move(r) : Drape{};
}

bool same_bytes(const Drape& a, const Drape& b) {
  for (std::size_t p = 0; p < 2; ++p)
    if (a.positions[p].size() != b.positions[p].size() ||
        std::memcmp(a.positions[p].data(), b.positions[p].data(), a.positions[p].size() * sizeof(Vec3)) != 0)
      return false;
  return a.work == b.work && a.level == b.level;
}

TEST(Budget, a_drape_stops_at_the_first_level_whose_estimate_is_within_what_was_asked) {
  const Drape all = drape(0, 0);
  ASSERT_EQ(all.levels.size(), 3u);
  const double first = all.levels[0].error_estimate_mm;
  ASSERT_GT(first, 0);
  int made = 0;
  const Drape one = drape(1.6e-3 * first, 0, &made);
  EXPECT_EQ(one.level, 0);
  EXPECT_EQ(made, 1) << "finer levels were made that nobody needed";
  EXPECT_LE(1.25 * *one.error_estimate_mm, 1.6 * first);
  EXPECT_EQ(one.status, "OK") << "it stopped before its final residual: " << one.residual;
  EXPECT_LE(one.residual, 1.05e-3);
  EXPECT_EQ(one.positions[0].size(), levels()[0].meshes[0].nodes.size());
}

TEST(Budget, a_tighter_error_never_gives_fewer_levels_and_what_is_not_met_is_told) {
  std::size_t before = 0;
  for (const double error : {1.0, 20e-3, 8e-3, 4e-3, 2e-3, 1e-3, 1e-5}) {
    const Drape d = drape(error, 0);
    ASSERT_FALSE(d.levels.empty());
    EXPECT_GE(d.levels.size(), before) << error;
    EXPECT_EQ(d.level + 1, static_cast<int>(d.levels.size()));
    ASSERT_TRUE(d.error_estimate_mm);
    EXPECT_TRUE(d.levels.size() == levels().size() || *d.error_estimate_mm <= 1e3 * error) << error;
    for (std::size_t l = 0; l + 1 < d.levels.size(); ++l) EXPECT_GT(1.25 * d.levels[l].error_estimate_mm, 1e3 * error);
    before = d.levels.size();
  }
  EXPECT_EQ(before, levels().size());
}

TEST(Budget, work_is_kept_to_and_what_it_ends_is_always_close_to_rest) {
  const double all = drape(0, 0).work;
  int before = 0;
  for (const double share : {1e-9, 0.02, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.95, 10.0}) {
    const Drape d = drape(0, share * all);
    EXPECT_LE(d.residual, 1.05e-2) << share;
    EXPECT_TRUE(d.level == 0 || d.work <= share * all * 1.05) << share << ": " << d.work << " of " << share * all;
    EXPECT_GE(d.level, before) << share;
    EXPECT_EQ(d.level + 1, static_cast<int>(d.levels.size()));
    EXPECT_TRUE(d.level == 2 || d.out_of_work) << share;
    before = d.level;
  }
  EXPECT_EQ(before, 2);
}

TEST(Budget, work_is_counted_so_that_the_same_request_gives_the_same_bytes) {
  const double all = drape(0, 0).work;
  for (const double share : {0.1, 0.7}) EXPECT_TRUE(same_bytes(drape(0, share * all), drape(0, share * all)));
}

TEST(Budget, no_budget_is_a_budget_that_is_never_reached) {
  EXPECT_TRUE(same_bytes(drape(0, 0), drape(1e-9, 0)));
  EXPECT_TRUE(same_bytes(drape(0, 0), drape(0, 1e15)));
}

TEST(Budget, numbers_that_are_none_are_refused) {
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    SewingOptions o;
    o.max_error = bad;
    auto r = sew_and_drape(levels(), scene::place_flat(levels().front(), 0.16), scene::cotton(), scene::woman(), o);
    ASSERT_FALSE(r);
    EXPECT_EQ(r.error().code, "SEWING_OPTION");
    o.max_error = 0;
    o.max_work = bad;
    r = sew_and_drape(levels(), scene::place_flat(levels().front(), 0.16), scene::cotton(), scene::woman(), o);
    ASSERT_FALSE(r);
    EXPECT_EQ(r.error().code, "SEWING_OPTION");
  }
}

}  // namespace
}  // namespace vitrine
