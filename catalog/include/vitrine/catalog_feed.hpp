// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "vitrine/catalog_input.hpp"

namespace vitrine {

enum class FeedPlatform {
  google,   ///< Merchant Center supplement: id and virtual_model_link
  shopify,  ///< media of products, as Shopify's CreateMediaInput has them
  items     ///< items.json: all that a show room or another program needs
};
enum class FeedFormat { tsv, xml, csv, json };

struct FeedOptions {
  FeedPlatform platform = FeedPlatform::items;
  FeedFormat format = FeedFormat::json;  ///< google: tsv or xml; shopify: csv; items: json
  std::string base_url;  ///< where the output folder is published, with http:// or https://; items: may be empty
  std::string model = "garment";        ///< or "dressed": which GLB is linked
  const CatalogInput* input = nullptr;  ///< titles, ids and sizes, with details; without it an item is its SKU
};

struct Feed {
  std::string text;
  int items = 0;                      ///< garments in it
  std::vector<std::string> warnings;  ///< limits that a platform advises
  std::vector<Error> left_out;        ///< items that break a limit of the platform
};

/// Makes a feed of a finished output folder, `out_dir`/SKU/[SIZE/]NAME.glb: items in the order of their SKUs, the same
/// bytes for the same files. Limits: addresses of at most 2,000 characters, GLB of at most 15 MB for Google (10
/// advised) and 500 MB for Shopify (15 advised); an item that breaks one is left out. Errors: missing (66: OUT_DIR),
/// usage (64: BASE_URL, MODEL), unusable (65: NO_MODELS).
Result<Feed> make_feed(const std::string& out_dir, const FeedOptions& options);

}  // namespace vitrine
