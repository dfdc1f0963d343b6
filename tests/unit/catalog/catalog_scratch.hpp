// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "scratch.hpp"
#include "vitrine/run_catalog.hpp"

/// A folder with catalogue options that write into its subfolder "out".
class CatalogScratch : public Scratch {
 protected:
  void SetUp() override {
    Scratch::SetUp();
    options.out_dir = (root / "out").string();
    options.progress = vitrine::ProgressKind::none;
  }
  static std::vector<vitrine::CatalogItem> items(const std::vector<std::string>& skus) {
    std::vector<vitrine::CatalogItem> list;
    for (const std::string& sku : skus) {
      vitrine::CatalogItem item;
      item.sku = sku;
      item.garment = "vest";
      list.push_back(item);
    }
    return list;
  }
  vitrine::CatalogSummary run(const std::vector<vitrine::CatalogItem>& list, const vitrine::ItemFunction& convert) {
    const auto result = vitrine::run_catalog(list, options, convert);
    EXPECT_TRUE(result) << (result ? "" : result.error().message);
    return result ? *result : vitrine::CatalogSummary{};
  }
  std::vector<std::string> report() const {
    std::vector<std::string> lines;
    std::ifstream in(root / "out/report.jsonl");
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }
  bool has(const std::string& name) const { return std::filesystem::exists(root / "out" / name); }
  /// Every file that a run promises to be the same bytes, by path: all but what the folder remembers and the times.
  static std::map<std::string, std::string> tree(const std::filesystem::path& out) {
    std::map<std::string, std::string> files;
    for (auto at = std::filesystem::recursive_directory_iterator(out); at != decltype(at)(); ++at) {
      const std::string name = at->path().filename().string();
      if (name == ".vitrine-catalog" || name == "shards") {
        at.disable_recursion_pending();
        continue;
      }
      if (at->is_symlink())
        files[at->path().lexically_relative(out).string()] = std::filesystem::read_symlink(at->path()).string();
      else if (at->is_regular_file() && name != "timings.jsonl")
        files[at->path().lexically_relative(out).string()] = read(at->path());
    }
    return files;
  }
  vitrine::CatalogOptions options;
};
