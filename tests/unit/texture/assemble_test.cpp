// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "scene.hpp"

namespace vitrine::test {
namespace {

/// Front and back sewn to a tube about the y axis along their left and right edges.
struct Tube {
  Pattern pattern;
  std::vector<std::vector<Vec3>> positions;
  std::vector<std::vector<std::uint32_t>> welded;
  Atlas atlas;

  explicit Tube(double depth = 0.1) {
    constexpr int n = 11;
    std::uint32_t next = 1000;  // numbers need not start at zero
    for (Side side : {Side::front, Side::back}) {
      const Shot shot = shoot(side, 100, plain);
      pattern.panels.push_back(shot.panel);
      pattern.meshes.push_back(shot.mesh);
      positions.emplace_back();
      welded.emplace_back();
      for (std::size_t k = 0; k < shot.mesh.nodes.size(); ++k) {
        const Vec2& p = shot.mesh.nodes[k];
        const double a = p.x() / 0.2 * std::numbers::pi / 2;
        const bool seam = k % n == 0 || k % n == n - 1;
        const double z = seam ? 0.0 : (side == Side::front ? depth : -depth) * std::cos(a);
        positions.back().emplace_back(0.15 * std::sin(a), p.y(), z);
        welded.back().push_back(side == Side::back && seam ? welded[0][k] : next++);
      }
      atlas.uv.emplace_back(shot.mesh.nodes.size(), Vec2(0.5, 0.5));
    }
  }
  RenderMesh build() const { return assemble_garment(pattern, positions, welded, atlas); }
};

TEST(Garment, winds_outwards_on_both_sides) {
  const RenderMesh m = Tube().build();
  ASSERT_EQ(m.triangles.size(), 400u);
  for (const Triangle& t : m.triangles) {
    const Vec3 &a = m.positions[t[0]], &b = m.positions[t[1]], &c = m.positions[t[2]];
    Vec3 outward = (a + b + c) / 3.0;
    outward.y() = 0;
    EXPECT_GT((b - a).cross(c - a).dot(outward), 0);
  }
}

TEST(Garment, shades_smoothly_over_the_seams_with_unit_normals) {
  const Tube tube;
  const RenderMesh m = tube.build();
  for (std::size_t v = 0; v < m.normals.size(); ++v) {
    EXPECT_NEAR(m.normals[v].norm(), 1.0, 1e-9);
    Vec3 outward = m.positions[v];
    outward.y() = 0;
    EXPECT_GT(m.normals[v].dot(outward.normalized()), 0.85);
  }
  const std::size_t nodes = tube.positions[0].size();
  int seams = 0;
  for (std::size_t a = 0; a < nodes; ++a)
    for (std::size_t b = 0; b < nodes; ++b)
      if (tube.welded[0][a] == tube.welded[1][b]) {
        EXPECT_EQ(m.normals[a], m.normals[nodes + b]);
        ++seams;
      }
  EXPECT_EQ(seams, 22);
}

TEST(Garment, splits_the_sewn_nodes_where_the_texture_is_cut) {
  const Tube tube;
  const RenderMesh m = tube.build();
  EXPECT_EQ(m.name, "garment");
  EXPECT_EQ(m.positions.size(), tube.positions[0].size() + tube.positions[1].size());
  EXPECT_EQ(m.uv.size(), m.positions.size());
}

TEST(Garment, has_unit_normals_even_where_cloth_is_pressed_flat_or_collapsed) {
  Tube flat(0.0);
  for (Vec3& p : flat.positions[0])
    if (p.y() > 0.3) p = Vec3(0, 0.3, 0);
  const RenderMesh m = flat.build();
  for (const Vec3& n : m.normals) EXPECT_NEAR(n.norm(), 1.0, 1e-9);
}

TEST(Garment, is_empty_when_its_parts_contradict_each_other) {
  Tube tube;
  tube.welded[1].pop_back();
  EXPECT_TRUE(tube.build().positions.empty());
  Tube other;
  other.pattern.meshes[0].triangles[0][1] = 99'999;
  EXPECT_TRUE(other.build().triangles.empty());
}

TEST(MannequinMesh, shades_smoothly_where_an_imported_body_is_split) {
  // An octahedron whose triangles share no vertex.
  TriMesh body;
  for (int s = 0; s < 8; ++s) {
    const Vec3 x((s & 1) ? 1 : -1, 0, 0), y(0, (s & 2) ? 1 : -1, 0), z(0, 0, (s & 4) ? 1 : -1);
    const auto base = static_cast<std::uint32_t>(body.vertices.size());
    const bool even = x.x() * y.y() * z.z() > 0;
    for (const Vec3& p : {x, even ? y : z, even ? z : y}) body.vertices.push_back(p);
    body.triangles.push_back({base, base + 1, base + 2});
  }
  const RenderMesh m = assemble_mannequin(body);
  EXPECT_EQ(m.name, "mannequin");
  ASSERT_EQ(m.normals.size(), 24u);
  for (std::size_t v = 0; v < m.normals.size(); ++v) EXPECT_LT((m.normals[v] - m.positions[v]).norm(), 1e-9);
  EXPECT_TRUE(m.texture.empty());
}

TEST(MannequinMesh, is_empty_when_a_vertex_is_no_place) {
  TriMesh body{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, std::numeric_limits<double>::infinity(), 0)}, {{0, 1, 2}}};
  EXPECT_TRUE(assemble_mannequin(body).positions.empty());
}

}  // namespace
}  // namespace vitrine::test
