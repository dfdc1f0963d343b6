// SPDX-License-Identifier: GPL-3.0-or-later
#include "read_input.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <unordered_set>

#include "feed_table.hpp"
#include "folder_name.hpp"
#include "manifest_fields.hpp"
#include "text.hpp"

namespace vitrine {

namespace fs = std::filesystem;

const char* name_of(InputKind kind) {
  switch (kind) {
    case InputKind::automatic:
      return "auto";
    case InputKind::manifest:
      return "manifest";
    case InputKind::folder:
      return "folder";
    case InputKind::shopify:
      return "shopify";
    case InputKind::google:
      return "google";
    case InputKind::woocommerce:
      return "woocommerce";
  }
  return "";
}

std::optional<InputKind> input_kind_of(const std::string& name) {
  for (const InputKind kind : {InputKind::automatic, InputKind::manifest, InputKind::folder, InputKind::shopify,
                               InputKind::google, InputKind::woocommerce})
    if (name == name_of(kind)) return kind;
  return {};
}

namespace input {
namespace {

char first_mark(std::string_view text) {
  const auto at = text.find_first_not_of(" \t\r\n");
  return at == std::string_view::npos ? '\0' : text[at];
}

Products read_products(const std::string& file, std::string_view text, InputKind kind, const Rules& rules) {
  const bool xml = first_mark(text) == '<';
  if (kind == InputKind::google && xml) return read_google_xml(file, text, rules);  // expat checks the encoding itself
  if (auto error = check_utf8(text, file, "FEED_ENCODING")) return *error;
  if (kind == InputKind::google) return read_google_table(file, text, rules);
  if (kind == InputKind::shopify) return read_shopify(file, text, rules);
  return read_woocommerce(file, text, rules);
}

/// Products become items; names of folders are made unique by refusing, never by counting, as a count would change
/// when a product before it goes.
CatalogInput items_of(std::vector<Product> products, const std::string& file, const Rules& rules, const ImageRoot* root,
                      bool details) {
  CatalogInput input;
  input.pictures_found = root != nullptr;
  std::unordered_set<std::string> names;
  for (Product& product : products) {
    ItemPlan plan;
    std::string why;
    std::optional<CatalogItem> item = make_item(product, rules, root, file, plan, why);
    if (!item) {
      input.left_out.push_back({one_line(product.id, 120), std::move(why), product.line});
      product = Product{};
      continue;
    }
    if (!names.insert(item->sku).second) {
      item->refusal = std::make_shared<const Error>(bad(
          "PRODUCT_ID", file + ":" + std::to_string(product.line),
          "\"" + one_line(product.id, 80) + "\" is the id of an earlier product too", "Give each product its own."));
      item->product_id = product.id;
      // The line tells the two apart.
      item->sku = folder_name(product.id + "\n" + std::to_string(product.line));
      while (!names.insert(item->sku).second) item->sku = folder_name(item->sku + "\n");
    }
    if (details) input.plan.push_back(std::move(plan));
    input.items.push_back(std::move(*item));
    product = Product{};  // texts are not needed twice
  }
  return input;
}

/// With an image root, a manifest's photos have to lie below it as well.
std::optional<Error> check_below(const std::vector<CatalogItem>& items, const std::string& file,
                                 const ImageRoot& root) {
  for (const CatalogItem& item : items)
    for (const std::string* photo : {&item.front, &item.back, &item.front_mask, &item.back_mask}) {
      if (photo->empty()) continue;
      std::error_code failed;
      const std::string real = fs::weakly_canonical(fs::absolute(*photo, failed), failed).string();
      const std::string folder = root.folder() == "/" ? "/" : root.folder() + "/";
      if (failed || real.compare(0, folder.size(), folder) != 0)
        return bad("MANIFEST_VALUE", file + ":" + std::to_string(item.line),
                   "\"" + one_line(*photo, 200) + "\" does not lie below the image root " + root.folder(),
                   "Move the photo there, or leave --image-root out.");
    }
  return {};
}

}  // namespace

Result<InputKind> kind_of(const std::string& file, std::string_view text, const Rules& rules) {
  const char mark = first_mark(text);
  if (mark == '<') return InputKind::google;
  if (mark == '{' || mark == '[') return InputKind::manifest;
  const std::vector<std::string> header = FeedTable::header_of(text, rules);
  const auto has = [&](const char* name) { return std::find(header.begin(), header.end(), name) != header.end(); };
  if ((has("handle") || has("url handle")) && (has("image src") || has("product image url"))) return InputKind::shopify;
  if (has("id") && has("image link")) return InputKind::google;
  if (has("images") && has("type") && has("name") && (has("sku") || has("id"))) return InputKind::woocommerce;
  if (has("sku") + has("garment") + has("front") >= 2 || mark == '\0') return InputKind::manifest;
  return bad("INPUT_KIND", file + ":1",
             "the columns are neither a manifest's nor those of a Shopify, Google or WooCommerce export",
             "Say what it is with --input-kind, or give the feed's names for its columns in the rules' \"columns\".");
}

Result<CatalogInput> read_input_text(const std::string& file, std::string_view text, InputKind kind, const Rules& rules,
                                     const ImageRoot* root, bool details) {
  if (kind == InputKind::automatic) {
    const auto found = kind_of(file, text, rules);
    if (!found) return found.error();
    kind = *found;
  }
  CatalogInput input;
  if (kind == InputKind::manifest) {
    if (text.size() > max_manifest_bytes)
      return bad("MANIFEST_TOO_LARGE", file, "the file has more than 64 MB", "Split it into several catalogues.");
    const char mark = first_mark(text);
    auto items = mark == '{' || mark == '[' ? read_json_manifest(file, text, input.warnings)
                                            : read_csv_manifest(file, text, input.warnings);
    if (!items) return items.error();
    if (root != nullptr)
      if (auto error = check_below(*items, file, *root)) return *error;
    input.items = std::move(*items);
    if (details)
      for (const CatalogItem& item : input.items) {
        ItemPlan plan;
        plan.ids = {item.product_id.empty() ? item.sku : item.product_id};
        plan.front_rule = plan.back_rule = plan.garment_rule = "manifest";
        if (item.mirror_back) plan.back_rule = "";
        input.plan.push_back(std::move(plan));
      }
  } else {
    Products products = read_products(file, text, kind, rules);
    if (!products) return products.error();
    if (products->empty())
      return bad("FEED_EMPTY", file, "the feed has no products", "Check the export; its first row names the columns.");
    input = items_of(std::move(*products), file, rules, root, details);
  }
  input.kind = kind;
  return input;
}

}  // namespace input

Result<CatalogInput> read_input(const std::string& path, const InputOptions& options) {
  const Result<input::Rules> rules = input::read_rules(options.rules);
  if (!rules) return rules.error();
  std::optional<input::ImageRoot> root;
  if (!options.image_root.empty()) {
    Result<input::ImageRoot> opened = input::ImageRoot::open(options.image_root);
    if (!opened) return opened.error();
    root = std::move(*opened);
  }
  std::error_code failed;
  const bool folder = fs::is_directory(path, failed);
  if (folder && options.kind != InputKind::automatic && options.kind != InputKind::folder)
    return input::bad("INPUT_KIND", path, std::string("a folder is no input of kind ") + name_of(options.kind),
                      "Give the file, or leave --input-kind out.");
  if (folder || options.kind == InputKind::folder) {
    Result<input::ImageRoot> photos = input::ImageRoot::open(path);
    if (!photos) return photos.error();
    std::vector<std::string> warnings;
    input::Products products = input::read_folder(*photos, *rules, warnings);
    if (!products) return products.error();
    if (products->empty())
      return input::bad("FEED_EMPTY", path, "no picture below this folder is named front or back",
                        "Name the files SKU_front.jpg and SKU_back.jpg, or SKU/front.jpg and SKU/back.jpg.");
    CatalogInput all = input::items_of(std::move(*products), path, *rules, &*photos, options.details);
    all.kind = InputKind::folder;
    all.warnings = std::move(warnings);
    return all;
  }
  Result<std::string> text = input::read_text(path, input::max_feed_bytes, "FEED_TOO_LARGE");
  if (!text) return text.error();
  return input::read_input_text(path, *text, options.kind, *rules, root ? &*root : nullptr, options.details);
}

Result<std::vector<CatalogItem>> read_items(const std::string& path, const InputOptions& options) {
  Result<CatalogInput> all = read_input(path, options);
  if (!all) return all.error();
  for (const std::string& warning : all->warnings) spdlog::warn("{}", warning);
  if (!all->pictures_found)
    return Error{Cause::usage, "IMAGE_ROOT", path + ": a " + name_of(all->kind) + " feed names its pictures by address",
                 "Give the folder where they lie as --image-root; nothing is downloaded.", "catalog"};
  if (!all->left_out.empty())
    spdlog::warn("{}: {} products are left out, such as \"{}\": {}; vitrine catalog plan lists them", path,
                 all->left_out.size(), all->left_out[0].id, all->left_out[0].reason);
  if (all->items.empty())
    return input::bad("FEED_EMPTY", path, "all " + std::to_string(all->left_out.size()) + " products are left out",
                      "See vitrine catalog plan for the reasons, and add rules for your garments.");
  return std::move(all->items);
}

}  // namespace vitrine
