// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scratch.hpp"
#include "vitrine/catalog_input.hpp"

/// Reads the invented shops' feeds, and feeds of a test's own.
class Inputs : public Scratch {
 protected:
  static std::string shop(const std::string& name) {
    return std::string(VITRINE_SOURCE_DIR) + "/tests/unit/catalog_input/feeds/" + name;
  }
  static vitrine::CatalogInput get(const std::string& path, vitrine::InputOptions options = {}) {
    options.details = true;
    auto read = vitrine::read_input(path, options);
    EXPECT_TRUE(read) << (read ? "" : read.error().message);
    return read ? std::move(*read) : vitrine::CatalogInput{};
  }
  static vitrine::Error error_of(const std::string& path, const vitrine::InputOptions& options = {}) {
    const auto read = vitrine::read_input(path, options);
    EXPECT_FALSE(read) << path;
    return read ? vitrine::Error{} : read.error();
  }
  static const vitrine::CatalogItem& item(const vitrine::CatalogInput& input, const std::string& sku) {
    static const vitrine::CatalogItem none;
    for (const auto& i : input.items)
      if (i.sku == sku) return i;
    ADD_FAILURE() << "no item " << sku;
    return none;
  }
  static vitrine::ItemPlan plan(const vitrine::CatalogInput& input, const std::string& sku) {
    for (std::size_t i = 0; i < input.items.size(); ++i)
      if (input.items[i].sku == sku) return input.plan.at(i);
    ADD_FAILURE() << "no item " << sku;
    return {};
  }
  static std::string code(const vitrine::CatalogItem& i) { return i.refusal ? i.refusal->code : ""; }
  static bool ends(const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
  }
  /// A picture, as far as names go.
  std::string picture(const std::string& name) const {
    std::filesystem::create_directories((root / name).parent_path());
    return write(name, "picture");
  }
};
