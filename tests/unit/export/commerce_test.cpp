// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/commerce.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "sample.hpp"

namespace vitrine::test {
namespace {

/// A garment that keeps every limit: 1,024 px of a middling colour, charts with a gutter.
RenderMesh good_garment() {
  RenderMesh m = textured_sheet(12);
  m.name = "garment_12-a";
  m.texture = Image(1024, 1024, 3, 120);
  for (Vec2& t : m.uv) t = Vec2(0.05, 0.05) + 0.9 * t;
  return m;
}

std::vector<CommerceFinding> findings(const std::vector<RenderMesh>& meshes, const CommerceScale& scale = {}) {
  const auto glb = encode_glb(meshes);
  EXPECT_TRUE(glb);
  const auto found = check_commerce(*glb, scale);
  EXPECT_TRUE(found) << (found ? "" : found.error().message);
  return found ? *found : std::vector<CommerceFinding>{};
}

CommerceFinding finding(const std::vector<CommerceFinding>& list, const std::string& rule) {
  const auto it = std::find_if(list.begin(), list.end(), [&](const CommerceFinding& f) { return f.rule == rule; });
  EXPECT_NE(it, list.end()) << rule;
  return it == list.end() ? CommerceFinding{} : *it;
}

Verdict verdict(const RenderMesh& mesh, const std::string& rule, const CommerceScale& scale = {}) {
  return finding(findings({mesh}, scale), rule).verdict;
}

TEST(Commerce, passes_a_garment_that_keeps_every_limit) {
  const CommerceScale scale{Vec3(-0.6, 0, -0.15), Vec3(0.6, 1.7, 0.15)};
  const auto list = findings({good_garment()}, scale);
  EXPECT_GE(list.size(), 18u);
  for (const CommerceFinding& f : list) {
    EXPECT_EQ(f.verdict, Verdict::pass) << f.rule << " " << f.value << ", asked " << f.limit;
    EXPECT_FALSE(f.sources.empty());
  }
}

TEST(Commerce, tells_what_is_wrong_by_its_rule) {
  RenderMesh m = good_garment();
  m.name = "12-A";
  EXPECT_EQ(verdict(m, "names"), Verdict::fail);

  m = good_garment();
  m.texture = Image(1000, 1024, 3, 120);
  EXPECT_EQ(verdict(m, "texture_power_of_two"), Verdict::fail);
  m.texture = Image(256, 256, 3, 120);
  EXPECT_EQ(verdict(m, "texture_smallest_side_px"), Verdict::warn);

  m = good_garment();
  m.texture = Image(1024, 1024, 3, 255);
  EXPECT_EQ(verdict(m, "colour_bright_share"), Verdict::warn);
  m.texture = Image(1024, 1024, 3, 10);
  EXPECT_EQ(verdict(m, "colour_dark_share"), Verdict::warn);

  m = good_garment();
  for (Vec2& t : m.uv) t.x() += 0.2;
  EXPECT_EQ(verdict(m, "uv_range"), Verdict::fail);
  m = good_garment();
  for (Vec2& t : m.uv) t.x() = 1.0 - t.x();
  EXPECT_EQ(verdict(m, "uv_inverted_triangles"), Verdict::fail);
  m = good_garment();
  for (Vec2& t : m.uv) t = (t - Vec2(0.05, 0.05)) / 0.9;
  EXPECT_EQ(verdict(m, "uv_gutter_px"), Verdict::warn);

  m = good_garment();
  for (Vec3& p : m.positions) p *= 100;
  EXPECT_EQ(verdict(m, "size_m"), Verdict::fail);
}

TEST(Commerce, finds_triangles_that_share_texels) {
  RenderMesh m = good_garment();
  EXPECT_EQ(finding(findings({m}), "uv_overlap_share").value, "0.0000");
  // The same sheet once more, on the same part of the texture.
  const auto base = static_cast<std::uint32_t>(m.positions.size());
  const RenderMesh once = m;
  for (std::size_t i = 0; i < once.positions.size(); ++i) {
    m.positions.push_back(once.positions[i] + Vec3(0, 0, 0.1));
    m.normals.push_back(once.normals[i]);
    m.uv.push_back(once.uv[i]);
  }
  for (Triangle t : once.triangles) {
    for (std::uint32_t& v : t) v += base;
    m.triangles.push_back(t);
  }
  EXPECT_EQ(verdict(m, "uv_overlap_share"), Verdict::fail);
}

TEST(Commerce, measures_the_gutter_between_two_charts) {
  RenderMesh m = good_garment();
  const RenderMesh once = m;
  for (Vec2& t : m.uv) t.x() = 0.05 + 0.4 * (t.x() - 0.05) / 0.9;
  const auto base = static_cast<std::uint32_t>(m.positions.size());
  // 0.45 to 0.47 of 1,024 px lies between them.
  for (std::size_t i = 0; i < once.positions.size(); ++i) {
    m.positions.push_back(once.positions[i]);
    m.normals.push_back(once.normals[i]);
    m.uv.emplace_back(0.47 + 0.4 * (once.uv[i].x() - 0.05) / 0.9, once.uv[i].y());
  }
  for (Triangle t : once.triangles) {
    for (std::uint32_t& v : t) v += base;
    m.triangles.push_back(t);
  }
  EXPECT_NEAR(std::stoi(finding(findings({m}), "uv_gutter_px").value), 20, 1);
}

TEST(Commerce, holds_size_and_place_against_the_mannequin) {
  const CommerceScale scale{Vec3(-0.6, 0, -0.15), Vec3(0.6, 1.7, 0.15)};
  RenderMesh m = good_garment();
  EXPECT_EQ(verdict(m, "scale_to_mannequin", scale), Verdict::pass);
  RenderMesh high = m;
  for (Vec3& p : high.positions) p.y() += 1;
  EXPECT_EQ(verdict(high, "scale_to_mannequin", scale), Verdict::fail);
  EXPECT_EQ(verdict(m, "origin", {Vec3(-0.6, 0.4, -0.15), Vec3(0.6, 2.1, 0.15)}), Verdict::warn);
}

TEST(Commerce, counts_what_costs_a_viewer_time) {
  RenderMesh m = plain_sheet("sheet", 250, 230);  // 115,000 triangles
  EXPECT_EQ(verdict(m, "triangles"), Verdict::warn);
  const auto list = findings({good_garment(), plain_sheet("mannequin", 3)});
  EXPECT_EQ(finding(list, "materials").value, "2");
  EXPECT_EQ(finding(list, "materials").verdict, Verdict::pass);
}

TEST(Commerce, refuses_what_is_no_glb) {
  const Bytes nothing, text{'n', 'o'};
  for (const Bytes& bytes : {nothing, text}) {
    const auto found = check_commerce(bytes);
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().exit_code(), 65);
  }
  auto glb = *encode_glb(std::vector<RenderMesh>{good_garment()});
  glb.resize(glb.size() / 2);
  EXPECT_FALSE(check_commerce(glb));
}

}  // namespace
}  // namespace vitrine::test
