// SPDX-License-Identifier: GPL-3.0-or-later
// Every panel of every garment on the real photos, meshed at the three qualities.
#include <cstdio>
#include <set>

#include "real_items.hpp"
#include "vitrine/pipeline.hpp"

namespace vitrine {
namespace {

/// A mesh is its panel: the outline untouched and one to one, nothing turned over, nothing missing.
void expect_covers(const Panel& panel, const PanelMesh& mesh, const std::string& name) {
  const auto n = static_cast<std::uint32_t>(panel.outline.size());
  ASSERT_GE(mesh.nodes.size(), n) << name;
  for (std::uint32_t i = 0; i < n; ++i) ASSERT_EQ(mesh.nodes[i], panel.outline[i]) << name;
  double twice = 0, wanted = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const Vec2 a = panel.outline[i] - panel.outline[0], b = panel.outline[(i + 1) % n] - panel.outline[0];
    wanted += a.x() * b.y() - a.y() * b.x();
  }
  std::set<std::pair<std::uint32_t, std::uint32_t>> directed;
  for (const Triangle& t : mesh.triangles) {
    const Vec2 a = mesh.nodes[t[1]] - mesh.nodes[t[0]], b = mesh.nodes[t[2]] - mesh.nodes[t[0]];
    const double area = a.x() * b.y() - a.y() * b.x();
    ASSERT_GT(area, 0) << name;
    twice += area;
    for (int k = 0; k < 3; ++k) ASSERT_TRUE(directed.insert({t[k], t[(k + 1) % 3]}).second) << name;
  }
  EXPECT_NEAR(twice, std::abs(wanted), 1e-9 * std::abs(wanted)) << name;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    ASSERT_NE(directed.count({i, j}), directed.count({j, i})) << name << ": segment " << i << " is no border edge";
  }
}

}  // namespace

TEST(RealMeshes, cover_every_panel_at_every_quality) {
  const PluginRegistry registry = test::built_in_plugins();
  const auto items = test::real_items(registry);
  if (items.empty()) GTEST_SKIP() << "the real photos are not beside this checkout (../shared/photos)";
  const auto body = test::default_body();
  ASSERT_NE(body, nullptr);

  int meshed = 0;
  for (const test::RealItem& item : items) {
    for (const auto& [quality, name] : {std::pair(Quality::draft, "draft"), std::pair(Quality::standard, "standard"),
                                        std::pair(Quality::fine, "fine")}) {
      ConvertRequest request = test::request_for(item, registry);
      request.quality = quality;
      request.body = body;
      const Conversion result = cut_and_mesh(request);
      if (result.error) {
        EXPECT_NE(result.error->stage, "mesh") << item.name << ": " << result.error->message;
        break;  // refused before the mesh: the same photo is refused at every quality
      }
      ++meshed;
      for (std::size_t panel = 0; panel < result.pattern.meshes.size(); ++panel) {
        const std::string label = item.name + " " + name + (panel == 0 ? " front" : " back");
        const PanelMesh& mesh = result.pattern.meshes[panel];
        expect_covers(result.pattern.panels[panel], mesh, label);
        const MeshStats s = measure_mesh(mesh);
        std::printf("%-32s %6d nodes  angle %4.1f  <1.3 %5.2f %%  >1.6 %6.2f %%  CV %.3f  valence 6 %5.1f %%\n",
                    label.c_str(), s.nodes, s.min_angle_deg, 100 * s.flat_share, 100 * s.good_share, s.edge_cv,
                    100 * s.valence6_share);
        EXPECT_GE(s.min_angle_deg, 15) << label;
        // Of the 200 or 300 triangles of a draft, two or three are more than one in a hundred.
        EXPECT_LE(s.flat_share, quality == Quality::draft ? 0.015 : 0.01) << label;
      }
    }
  }
  EXPECT_GE(meshed, 3 * 0.8 * static_cast<double>(items.size()));
}

}  // namespace vitrine
