// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <limits>

#include "scene.hpp"
#include "vitrine/sewing.hpp"

namespace vitrine {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class Refusal : public testing::Test {
 protected:
  std::vector<Pattern> levels{scene::make_pattern(scene::vest(), 0.1)};
  std::vector<std::vector<Vec3>> placed = scene::place_flat(levels.front(), 0.16);
  Fabric fabric = scene::cotton();
  DistanceField body = scene::woman();
  SewingOptions options;

  void expect(Cause cause, const std::string& code, const std::string& word) {
    const auto r = sew_and_drape(levels, placed, fabric, body, options);
    ASSERT_FALSE(r);
    EXPECT_EQ(r.error().cause, cause);
    EXPECT_EQ(r.error().code, code);
    EXPECT_NE(r.error().message.find(word), std::string::npos) << r.error().message;
    EXPECT_FALSE(r.error().remedy.empty());
  }
};

TEST_F(Refusal, names_the_fabric_field_that_is_negative_or_no_number) {
  const std::pair<const char*, double Fabric::*> fields[] = {{"stretch", &Fabric::stretch},
                                                             {"shear", &Fabric::shear},
                                                             {"bend", &Fabric::bend},
                                                             {"mass", &Fabric::mass},
                                                             {"friction", &Fabric::friction}};
  for (const auto& [name, field] : fields)
    for (const double bad : {-1.0, nan, std::numeric_limits<double>::infinity()}) {
      fabric = scene::cotton();
      fabric.*field = bad;
      expect(Cause::usage, "FABRIC_VALUE", name);
    }
}

TEST_F(Refusal, names_k_m_and_the_stretch_of_a_fabric_that_cannot_hold_itself) {
  fabric.stretch = 0.01;
  fabric.mass = 1;
  expect(Cause::usage, "FABRIC_TOO_SOFT", "k = 0.01 N/m and m = 1 kg/m^2");
  fabric.stretch = fabric.shear = 0;
  expect(Cause::usage, "FABRIC_TOO_SOFT", "both 0");
}

TEST_F(Refusal, of_bad_options) {
  options.residual = 0;
  expect(Cause::usage, "SEWING_OPTION", "residual");
  options = {};
  options.offset = nan;
  expect(Cause::usage, "SEWING_OPTION", "offset");
  options = {};
  options.gravity = -1;
  expect(Cause::usage, "SEWING_OPTION", "gravity");
  options = {};
  options.spring_k = -1;
  expect(Cause::usage, "SEWING_OPTION", "spring_k");
  options = {};
  options.node_mass = nan;
  expect(Cause::usage, "SEWING_OPTION", "node_mass");
  options = {};
  options.max_iterations = 0;
  expect(Cause::usage, "SEWING_OPTION", "max_iterations");
}

TEST_F(Refusal, of_broken_patterns) {
  const auto good = levels;
  levels.clear();
  expect(Cause::unusable, "PATTERN_LEVELS", "0 pattern levels");
  levels = good;
  levels[0].meshes.pop_back();
  expect(Cause::unusable, "PATTERN_PANELS", "1 panels");
  levels = good;
  levels[0].meshes[1].triangles.clear();
  expect(Cause::unusable, "PATTERN_MESH", "no triangles");
  levels = good;
  levels[0].meshes[0].triangles[3][1] = 1'000'000;
  expect(Cause::unusable, "PATTERN_MESH", "not there");
  levels = good;
  levels[0].meshes[0].nodes[2].x() = nan;
  expect(Cause::unusable, "PATTERN_MESH", "not a place");
  levels = good;
  levels[0].pairs[0].node_b = -3;
  expect(Cause::unusable, "PATTERN_SEAM", "not there");
  levels = good;
  for (Vec2& n : levels[0].meshes[0].nodes) n.y() = 0;
  expect(Cause::unusable, "PATTERN_MESH", "no area");
}

TEST_F(Refusal, of_pieces_that_nothing_holds) {
  const auto good = levels;
  PanelMesh& front = levels[0].meshes[0];
  const auto first = static_cast<std::uint32_t>(front.nodes.size());
  front.nodes.insert(front.nodes.end(), {{0, 1}, {0.1, 1}, {0, 1.1}});
  front.triangles.push_back({first, first + 1, first + 2});
  placed[0].insert(placed[0].end(), {{0, 1, 0.16}, {0.1, 1, 0.16}, {0, 1.1, 0.16}});
  expect(Cause::unusable, "PATTERN_PIECES", "3 nodes in the front panel");
  levels = good;
  levels[0].pairs.clear();
  placed = scene::place_flat(levels.front(), 0.16);
  expect(Cause::unusable, "PATTERN_PIECES", "sewn to nothing");
}

TEST_F(Refusal, of_seams_sewn_the_wrong_way_round_or_of_lengths_that_do_not_belong_together) {
  const auto good = levels;
  std::vector<std::size_t> side;
  for (std::size_t i = 0; i < good[0].pairs.size(); ++i)
    if (good[0].pairs[i].seam == good[0].pairs.front().seam) side.push_back(i);
  ASSERT_GE(side.size(), 4u);
  for (std::size_t i = 0; i < side.size(); ++i)
    levels[0].pairs[side[i]].node_b = good[0].pairs[side[side.size() - 1 - i]].node_b;
  expect(Cause::unusable, "PATTERN_SEAM", "run against each other");
  levels = good;
  for (const std::size_t i : side) {
    Vec2& n = levels[0].meshes[1].nodes[levels[0].pairs[i].node_b];
    const Vec2 end = good[0].meshes[1].nodes[good[0].pairs[side[0]].node_b];
    n = end + 0.2 * (n - end);
  }
  expect(Cause::unusable, "PATTERN_SEAM", "joins an edge of");
}

TEST_F(Refusal, of_placements_that_do_not_belong_to_the_pattern_or_the_body) {
  placed[0].pop_back();
  expect(Cause::unusable, "PLACEMENT", "first level");
  placed = scene::place_flat(levels.front(), 0.16);
  placed[1][4].z() = nan;
  expect(Cause::unusable, "PLACEMENT", "not a place");
  placed = scene::place_flat(levels.front(), 0.16, 10);
  expect(Cause::unusable, "NOT_SUPPORTED", "beside the body");
}

TEST_F(Refusal, of_an_empty_body) {
  body = {};
  expect(Cause::unusable, "NO_BODY", "empty");
  body = scene::woman();
  body.values.back() = std::numeric_limits<float>::quiet_NaN();
  expect(Cause::unusable, "NO_BODY", "not a number");
  body = scene::woman();
  for (float& v : body.values) v = -v;
  expect(Cause::unusable, "NO_BODY", "inside out");
}

}  // namespace
}  // namespace vitrine
