// SPDX-License-Identifier: GPL-3.0-or-later
// The whole path on the real photos beside the checkout: every front of a garment that a plugin describes, with its
// back where there is one and a mirrored back otherwise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "real_items.hpp"

namespace vitrine {
namespace {

bool finite(const RenderMesh& mesh) {
  for (const auto* list : {&mesh.positions, &mesh.normals})
    for (const Vec3& v : *list)
      if (!v.allFinite()) return false;
  return !mesh.positions.empty();
}

/// What a sewn garment is as a surface.
struct Surface {
  int pieces = 0;                ///< connected
  std::vector<double> openings;  ///< [m] girth of each closed boundary
};

Surface surface_of(const Conversion& item) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  std::map<std::uint32_t, Vec3> at;
  for (std::size_t panel = 0; panel < item.pattern.meshes.size(); ++panel) {
    const auto& id = item.drape.welded[panel];
    for (std::size_t node = 0; node < id.size(); ++node) at[id[node]] = item.drape.positions[panel][node];
    for (const Triangle& t : item.pattern.meshes[panel].triangles)
      for (int k = 0; k < 3; ++k) ++uses[std::minmax(id[t[k]], id[t[(k + 1) % 3]])];
  }
  std::map<std::uint32_t, std::uint32_t> piece, rim;
  const auto root = [](std::map<std::uint32_t, std::uint32_t>& tree, std::uint32_t n) {
    for (tree.try_emplace(n, n); tree.at(n) != n;) n = tree.at(n);
    return n;
  };
  for (const auto& [edge, count] : uses) {
    piece[root(piece, edge.first)] = root(piece, edge.second);
    if (count == 1) rim[root(rim, edge.first)] = root(rim, edge.second);
  }
  Surface surface;
  for (const auto& [node, parent] : piece) surface.pieces += node == parent;
  std::map<std::uint32_t, double> girth;
  for (const auto& [edge, count] : uses)
    if (count == 1) girth[root(rim, edge.first)] += (at[edge.first] - at[edge.second]).norm();
  for (const auto& [node, length] : girth) surface.openings.push_back(length);
  return surface;
}

/// Every run of open edges is an opening of the sewn garment where it ends front and back: neck, hem and both arms; of
/// a skirt waist and hem.
std::size_t openings_of(const GarmentTemplate& garment) {
  return static_cast<std::size_t>(std::count_if(garment.edges.begin(), garment.edges.end(),
                                                [](const TemplateEdge& edge) { return edge.kind != EdgeKind::seam; }));
}

}  // namespace

TEST(RealPhotos, most_convert_within_the_bars_and_the_rest_say_why) {
  const PluginRegistry registry = test::built_in_plugins();
  const auto items = test::real_items(registry);
  if (items.empty()) GTEST_SKIP() << "the real photos are not beside this checkout (../shared/photos)";
  const auto body = test::default_body();
  ASSERT_NE(body, nullptr);

  int converted = 0;
  for (const test::RealItem& item : items) {
    ConvertRequest request = test::request_for(item, registry);
    request.quality = Quality::draft;
    request.body = body;
    const Conversion result = convert(request);
    const Drape& d = result.drape;
    std::printf("%-14s %-16s residual %.1e gap %.2f mm penetration %.2f mm strain p99 %.3f %s\n", item.name.c_str(),
                result.error ? result.error->code.c_str() : "OK", d.residual, d.seam_gap_mm_max, d.penetration_mm_max,
                d.strain_p99, result.error ? result.error->message.c_str() : "");
    if (result.error) {
      EXPECT_EQ(result.exit_code(), 65) << item.name;
      EXPECT_FALSE(result.error->remedy.empty()) << item.name;
      continue;
    }
    ++converted;
    EXPECT_LE(d.seam_gap_mm_max, 1.0) << item.name;
    EXPECT_LE(d.penetration_mm_max, 0.5) << item.name;
    EXPECT_LE(d.residual, 1e-2) << item.name;
    EXPECT_TRUE(finite(result.garment)) << item.name;
    const Surface surface = surface_of(result);
    EXPECT_EQ(surface.pieces, 1) << item.name;
    EXPECT_EQ(surface.openings.size(), openings_of(request.garment)) << item.name;
    for (const double girth : surface.openings) EXPECT_GT(girth, 0.12) << item.name << ": an opening is closed";
  }
  std::printf("real photos: %d of %zu converted\n", converted, items.size());
  EXPECT_GE(converted, 0.8 * static_cast<double>(items.size()));
}

}  // namespace vitrine
