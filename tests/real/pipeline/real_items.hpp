// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The real photos beside the checkout as items to convert: every front of a garment that a plugin describes, with its
// back where there is one and a mirrored back otherwise.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "vitrine/host/registry.hpp"
#include "vitrine/pipeline.hpp"

namespace vitrine::test {

struct RealItem {
  std::string name, garment, front, back;
};

/// A row whose garment no plugin describes is counted and said.
inline std::vector<RealItem> real_items(const PluginRegistry& registry) {
  static const std::map<std::string, std::string> plugin_of = {{"longsleeve", "long_sleeve"}, {"tshirt", "t_shirt"}};
  namespace fs = std::filesystem;
  const fs::path photos = fs::path(VITRINE_SOURCE_DIR) / ".." / "shared" / "photos";
  std::vector<RealItem> items;
  std::ifstream index(photos / "index.tsv");
  std::string line;
  while (std::getline(index, line)) {
    std::istringstream row(line);
    std::string file, garment, neckline, view;
    for (auto* field : {&file, &garment, &neckline, &view}) std::getline(row, *field, '\t');
    if (view != "front") continue;
    RealItem item;
    item.name = file.substr(0, file.find("-front"));
    item.garment = plugin_of.contains(garment) ? plugin_of.at(garment) : garment;
    if (!registry.find_garment(item.garment)) {
      std::printf("%s left out: no plugin for %s\n", item.name.c_str(), item.garment.c_str());
      continue;
    }
    item.front = (photos / file).string();
    std::string back = file;
    back.replace(back.find("front"), 5, "back");
    if (fs::exists(photos / back)) item.back = (photos / back).string();
    items.push_back(item);
  }
  return items;
}

inline PluginRegistry built_in_plugins() {
  PluginSearch search;
  search.folders = {std::string(VITRINE_BINARY_DIR) + "/lib/vitrine-1/plugins"};
  return PluginRegistry::load(search);
}

/// The default mannequin with its voxels; null when it cannot be made.
inline std::shared_ptr<const Body> default_body() {
  auto mannequin = build_mannequin({});
  if (!mannequin) return nullptr;
  auto field = voxelise(mannequin->mesh);
  if (!field) return nullptr;
  auto body = std::make_shared<Body>();
  body->mannequin = *std::move(mannequin);
  body->field = *std::move(field);
  return body;
}

inline ConvertRequest request_for(const RealItem& item, const PluginRegistry& registry) {
  ConvertRequest request;
  request.name = item.name;
  request.front = item.front;
  request.back = item.back;
  request.mirror_back = item.back.empty();
  const GarmentTemplate* garment = registry.find_garment(item.garment);
  EXPECT_NE(garment, nullptr) << item.garment;
  if (garment) request.garment = *garment;
  request.necklines.assign(registry.necklines().begin(), registry.necklines().end());
  request.others.assign(registry.garments().begin(), registry.garments().end());
  return request;
}

}  // namespace vitrine::test
