// SPDX-License-Identifier: GPL-3.0-or-later
// The whole path on the real photos beside the checkout: every front of vest, long sleeve and skirt, with its back
// where there is one and a mirrored back otherwise.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "vitrine/host/registry.hpp"
#include "vitrine/pipeline.hpp"

namespace vitrine {
namespace {

namespace fs = std::filesystem;
const fs::path photos = fs::path(VITRINE_SOURCE_DIR) / ".." / "shared" / "photos";

struct Item {
  std::string name, garment, front, back;
};

std::vector<Item> real_items() {
  std::vector<Item> items;
  std::ifstream index(photos / "index.tsv");
  std::string line;
  while (std::getline(index, line)) {
    std::istringstream row(line);
    std::string file, garment, neckline, view;
    for (auto* field : {&file, &garment, &neckline, &view}) std::getline(row, *field, '\t');
    if (view != "front" || (garment != "vest" && garment != "longsleeve" && garment != "skirt")) continue;
    Item item;
    item.name = file.substr(0, file.find("-front"));
    item.garment = garment == "longsleeve" ? "long_sleeve" : garment;
    item.front = (photos / file).string();
    std::string back = file;
    back.replace(back.find("front"), 5, "back");
    if (fs::exists(photos / back)) item.back = (photos / back).string();
    items.push_back(item);
  }
  return items;
}

bool finite(const RenderMesh& mesh) {
  for (const auto* list : {&mesh.positions, &mesh.normals})
    for (const Vec3& v : *list)
      if (!v.allFinite()) return false;
  return !mesh.positions.empty();
}

}  // namespace

TEST(RealPhotos, most_convert_within_the_bars_and_the_rest_say_why) {
  const auto items = real_items();
  if (items.empty()) GTEST_SKIP() << "the real photos are not beside this checkout (../shared/photos)";
  PluginSearch search;
  search.folders = {std::string(VITRINE_BINARY_DIR) + "/lib/vitrine-1/plugins"};
  const PluginRegistry registry = PluginRegistry::load(search);
  auto body = std::make_shared<Body>();
  auto mannequin = build_mannequin({});
  ASSERT_TRUE(mannequin);
  body->mannequin = *std::move(mannequin);
  auto field = voxelise(body->mannequin.mesh);
  ASSERT_TRUE(field);
  body->field = *std::move(field);

  int converted = 0;
  for (const Item& item : items) {
    const GarmentTemplate* garment = registry.find_garment(item.garment);
    ASSERT_NE(garment, nullptr) << item.garment;
    ConvertRequest request;
    request.name = item.name;
    request.front = item.front;
    request.back = item.back;
    request.mirror_back = item.back.empty();
    request.garment = *garment;
    request.necklines.assign(registry.necklines().begin(), registry.necklines().end());
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
    EXPECT_LE(d.seam_gap_mm_max, 3.0) << item.name;
    EXPECT_LE(d.penetration_mm_max, 2.0) << item.name;
    EXPECT_LE(d.residual, 1e-2) << item.name;
    EXPECT_TRUE(finite(result.garment)) << item.name;
  }
  std::printf("real photos: %d of %zu converted\n", converted, items.size());
  EXPECT_GE(converted, 17);
}

}  // namespace vitrine
