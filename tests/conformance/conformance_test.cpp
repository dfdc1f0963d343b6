// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "vitrine/host/registry.hpp"

namespace vitrine {
namespace {

namespace fs = std::filesystem;

const fs::path shipped = fs::path(VITRINE_BINARY_DIR) / "lib/vitrine-1/plugins";

const PluginRegistry& all() {
  static const PluginRegistry registry = PluginRegistry::load({{}, {shipped}, false});
  return registry;
}

std::vector<fs::path> plugin_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Names that a library exports, or nothing where nm is not installed.
std::optional<std::vector<std::string>> exported_symbols(const fs::path& file) {
  FILE* pipe = ::popen(("nm -D --defined-only '" + file.string() + "' 2>/dev/null").c_str(), "r");
  if (!pipe) return std::nullopt;
  std::string text;
  std::array<char, 512> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), n);
  if (::pclose(pipe) != 0) return std::nullopt;
  std::istringstream lines(text);
  std::vector<std::string> names;
  for (std::string address, type, name; lines >> address >> type >> name;) names.push_back(name);
  return names;
}

TEST(Plugins, are_all_adopted) {
  for (const RejectedPlugin& rejected : all().rejected()) ADD_FAILURE() << rejected.error.message;
  EXPECT_GE(all().plugins().size(), 6u);
  EXPECT_EQ(all().plugins().size(), plugin_files(shipped).size());
}

TEST(Plugins, export_their_entry_and_nothing_else) {
  ASSERT_TRUE(exported_symbols(shipped / "vest.vitrine.so")) << "nm is missing; it comes with the compiler";
  for (const fs::path& file : plugin_files(shipped)) {
    const auto symbols = exported_symbols(file);
    ASSERT_TRUE(symbols) << file;
    EXPECT_THAT(*symbols, testing::ElementsAre("vitrine_plugin_entry")) << file;
  }
}

TEST(Plugins, put_every_feature_of_a_pose_inside_the_unit_box) {
  for (const GarmentTemplate& g : all().garments())
    for (const TemplatePose& pose : g.poses) {
      ASSERT_EQ(pose.uv.size(), g.features.size());
      for (std::size_t i = 0; i < pose.uv.size(); ++i) {
        EXPECT_TRUE((pose.uv[i].array() >= 0).all() && (pose.uv[i].array() <= 1).all()) << g.id << " " << pose.name;
        EXPECT_GT(pose.radius[i], 0);
      }
    }
}

// Ours are symmetric garments; a plugin need not be.
TEST(Plugins, tables_are_mirror_symmetric) {
  for (const GarmentTemplate& g : all().garments()) {
    for (const TemplatePose& pose : g.poses)
      for (std::size_t i = 0; i < g.features.size(); ++i) {
        const int partner = g.features[i].mirror;
        ASSERT_GE(partner, 0) << g.id << ": " << g.features[i].name;
        const std::string where = g.id + ", pose " + pose.name + ": " + g.features[i].name;
        EXPECT_NEAR(pose.uv[i].x() + pose.uv[partner].x(), 1, 1e-12) << where;
        EXPECT_EQ(pose.uv[i].y(), pose.uv[partner].y()) << where;
        EXPECT_EQ(pose.radius[i], pose.radius[partner]) << where;
        EXPECT_EQ(g.features[i].turn, g.features[partner].turn) << where;
      }
    std::map<std::pair<int, int>, EdgeKind> kinds;
    for (const TemplateEdge& e : g.edges) kinds[{e.from, e.to}] = e.kind;
    for (const TemplateEdge& e : g.edges) {
      const auto mirrored = kinds.find({g.features[e.to].mirror, g.features[e.from].mirror});
      ASSERT_NE(mirrored, kinds.end()) << g.id << ": " << e.name;
      EXPECT_EQ(mirrored->second, e.kind) << g.id << ": " << e.name;
    }
  }
}

TEST(Plugins, seams_join_front_and_back_edges_of_one_name) {
  for (const GarmentTemplate& g : all().garments()) {
    std::set<int> sewn;
    for (const TemplateSeam& seam : g.seams) {
      EXPECT_EQ(seam.edge_a, seam.edge_b);
      EXPECT_NE(seam.side_a, seam.side_b);
      EXPECT_FALSE(seam.reversed);
      EXPECT_EQ(g.edges[seam.edge_a].kind, EdgeKind::seam);
      sewn.insert(seam.edge_a);
    }
    for (std::size_t e = 0; e < g.edges.size(); ++e)
      EXPECT_EQ(sewn.contains(static_cast<int>(e)), g.edges[e].kind == EdgeKind::seam)
          << g.id << ": " << g.edges[e].name;
  }
}

// Garments and necklines do not know each other: every neckline must lie on every neck edge, in every pose, without
// leaving the garment.
TEST(Plugins, every_neckline_fits_every_garment_with_a_neck) {
  int pairs = 0;
  for (const GarmentTemplate& g : all().garments()) {
    if (g.neck_edge() < 0) continue;
    for (const NecklineTemplate& n : all().necklines())
      for (const TemplatePose& pose : g.poses) {
        const TemplateEdge& neck = g.edges[g.neck_edge()];
        const Vec2 from = pose.uv[neck.from], to = pose.uv[neck.to];
        const double hem = pose.uv[g.scale.bottom].y();
        for (const Vec2& p : n.profile) {
          const Vec2 at = from + p.x() * (to - from) + Vec2(0, p.y() * n.default_depth * (to - from).norm());
          EXPECT_LT(at.y(), hem) << g.id << " with " << n.id << " in pose " << pose.name;
        }
        ++pairs;
      }
  }
  EXPECT_GE(pairs, 6);
}

TEST(Plugins, ratio_ranges_of_the_necklines_leave_no_gap_and_share_a_range_only_where_depth_tells_them_apart) {
  std::vector<std::pair<double, double>> ranges;
  for (const NecklineTemplate& n : all().necklines()) {
    ranges.emplace_back(n.ratio_min, n.ratio_max);
    for (const NecklineTemplate& other : all().necklines()) {
      if (&n != &other && n.ratio_min < other.ratio_max && other.ratio_min < n.ratio_max) {
        EXPECT_GE(std::abs(std::log(n.default_depth / other.default_depth)), std::log(2)) << n.id << ", " << other.id;
      }
    }
  }
  std::sort(ranges.begin(), ranges.end());
  ASSERT_FALSE(ranges.empty());
  EXPECT_EQ(ranges.front().first, 0);
  double reached = 0;
  for (const auto& [from, to] : ranges) {
    EXPECT_LE(from, reached);
    reached = std::max(reached, to);
  }
  EXPECT_GE(reached, 100);
}

}  // namespace
}  // namespace vitrine
