// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "vitrine/host/registry.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine::bench {

/// What a bench converts.
struct Item {
  std::string name, garment, front, back;  ///< back: empty where the front is mirrored
  std::string mask;                        ///< the front's silhouette as a person marked it; may be empty
  double chest = 0, length = 0;            ///< [m]
};

/// Fronts listed in a folder's index.tsv (file, garment, neckline, view, ...), of the garments that are loaded.
inline std::vector<Item> marked_photos(const std::filesystem::path& folder, const PluginRegistry& registry) {
  std::vector<Item> items;
  std::ifstream index(folder / "index.tsv");
  std::string line;
  while (std::getline(index, line)) {
    std::istringstream row(line);
    std::string file, garment, neckline, view;
    for (auto* field : {&file, &garment, &neckline, &view}) std::getline(row, *field, '\t');
    if (garment == "longsleeve") garment = "long_sleeve";
    if (garment == "tshirt") garment = "t_shirt";
    if (view != "front" || !registry.find_garment(garment)) continue;
    Item item;
    item.name = file.substr(0, file.find("-front"));
    item.garment = garment;
    item.front = (folder / file).string();
    item.mask = (folder / (std::filesystem::path(file).stem().string() + ".mask.png")).string();
    file.replace(file.find("front"), 5, "back");
    if (std::filesystem::exists(folder / file)) item.back = (folder / file).string();
    items.push_back(std::move(item));
  }
  return items;
}

/// A value that a bench cannot go on without.
template <class T>
T must(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().code + ": " + result.error().message);
  return *std::move(result);
}

}  // namespace vitrine::bench
