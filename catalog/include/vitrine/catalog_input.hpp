// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "vitrine/catalog.hpp"

namespace vitrine {

/// What a catalogue is given as. `automatic` tells them apart by their first row or first character.
enum class InputKind {
  automatic,
  manifest,    ///< Vitrine's own, CSV or JSON: exact, and refused as a whole when it has a mistake
  folder,      ///< SKU_front.jpg and SKU_back.jpg, or SKU/front.jpg
  shopify,     ///< product export, CSV, both generations of column names
  google,      ///< Merchant Center product feed, tab-separated or XML (RSS, Atom)
  woocommerce  ///< product export, CSV
};
const char* name_of(InputKind kind);
std::optional<InputKind> input_kind_of(const std::string& name);

struct InputOptions {
  InputKind kind = InputKind::automatic;
  std::string rules;       ///< JSON file that says how a feed is read; empty = the built-in rules
  std::string image_root;  ///< folder with the feed's pictures: nothing outside it is read, nothing is downloaded
  bool details = false;    ///< fill CatalogInput::plan
};

/// One picture of a product and what it was taken for.
struct PicturePlan {
  std::string source;  ///< as the input names it: URL or path
  std::string alt;
  int position = 0;  ///< from 1
  std::string role;  ///< front, back, front_mask, back_mask or other
  std::string rule;  ///< name of the rule that decided; empty when none did
};

/// Why an item is as it is.
struct ItemPlan {
  std::string handle;              ///< the product's name in the shop's addresses, or empty
  std::vector<std::string> ids;    ///< every product id that the model serves: sizes of one garment share it
  std::vector<std::string> sizes;  ///< as the shop calls them
  std::string garment_rule, neckline_rule, fabric_rule, front_rule, back_rule;  ///< empty: a default or nothing
  std::vector<PicturePlan> pictures;
  std::vector<std::string> notes;
};

/// A product that is no garment for us, by a rule.
struct LeftOut {
  std::string id, reason;
  int line = 0;
};

struct CatalogInput {
  InputKind kind = InputKind::manifest;
  std::vector<CatalogItem> items;  ///< in the input's order; those that cannot be converted have a `refusal`
  std::vector<ItemPlan> plan;      ///< one for each item with InputOptions::details, else empty
  std::vector<LeftOut> left_out;
  std::vector<std::string> warnings;
  bool pictures_found = true;  ///< false when a feed names URLs and no image root was given
};

/// Reads any of the inputs. A manifest with a mistake is refused as a whole. Of a feed, only a text that cannot be read
/// to its end is: a product with a mistake becomes an item with a refusal, a product that no rule calls a garment is
/// left out. Bounds: manifest 64 MB, feed 256 MB, 1,000,000 rows, 64 pictures of a product, 2,000,000 files below the
/// image root, rules 1 MB; text of a product is cut at 4 KB.
/// Errors: missing (66: MANIFEST_MISSING, IMAGE_ROOT), unusable (65: the codes of read_manifest, INPUT_KIND, FEED_XML,
/// FEED_CSV, FEED_ENCODING, FEED_TOO_LARGE, FEED_EMPTY, RULES, IMAGE_ROOT_TOO_LARGE).
/// Refusals: PICTURE_MISSING (66), NO_FRONT, NO_BACK, NO_GARMENT, PRODUCT_ROW, PRODUCT_VALUE, PRODUCT_ID (65).
Result<CatalogInput> read_input(const std::string& path, const InputOptions& options = {});

/// The items of any input, ready to run: read_input, and an error (64, IMAGE_ROOT) where a feed names its pictures by
/// URL and no image root says where they lie. Warnings and the number of products left out are logged.
Result<std::vector<CatalogItem>> read_items(const std::string& path, const InputOptions& options = {});

/// What a run would convert, and why: a table for people, or JSON. Neither looks at a photo.
std::string plan_table(const CatalogInput& input);
std::string plan_json(const CatalogInput& input);

/// Writes the items without a refusal as Vitrine's own manifest, CSV or (by the name's end) JSON; reading it gives the
/// same items. Photos below the manifest's folder are named from there, others by their whole path. Error: cannot
/// write (73: MANIFEST_WRITE), a file's name that a manifest cannot hold (65: MANIFEST_VALUE).
std::optional<Error> write_manifest(const std::vector<CatalogItem>& items, const std::string& path);

/// The built-in rules as a file to begin one's own with.
std::string default_rules();

}  // namespace vitrine
