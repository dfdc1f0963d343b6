// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vitrine/catalog_input.hpp"

namespace vitrine::input {

struct Picture {
  std::string source;  ///< URL or path, as the feed has it
  std::string alt;
  int position = 0;  ///< from 1; 0 = in the order of appearance
};

/// A product as any feed tells of it, before a rule has looked at it. Texts are one line and at most 4 KB.
struct Product {
  std::string id;      ///< what the item is named after
  std::string handle;  ///< in the shop's addresses, or empty
  std::string title, type, category, tags, description, color, gender, material, status;
  std::vector<std::string> ids;    ///< of its variants, or its own
  std::vector<std::string> sizes;  ///< each once
  std::vector<Picture> pictures;
  std::vector<std::pair<std::size_t, std::string>> columns;  ///< what the rules' measures ask for: index and value
  std::vector<std::string> notes;
  std::optional<Error> refusal;
  int line = 0;
};

constexpr std::size_t max_pictures = 64;
constexpr std::size_t max_id = 256;  ///< [byte]

struct Rules;
class ImageRoot;

/// What a feed reader gives: products, or why the feed cannot be read at all.
using Products = Result<std::vector<Product>>;
Products read_shopify(const std::string& file, std::string_view text, const Rules& rules);
Products read_google_table(const std::string& file, std::string_view text, const Rules& rules);
Products read_google_xml(const std::string& file, std::string_view text, const Rules& rules);
Products read_woocommerce(const std::string& file, std::string_view text, const Rules& rules);
Products read_folder(const ImageRoot& root, const Rules& rules, std::vector<std::string>& warnings);

/// Adds a picture unless the product has it already or has 64.
void add_picture(Product& product, const std::string& source, const std::string& alt, int position);
/// Adds a text unless it is empty or in the list already.
void add_once(std::vector<std::string>& list, const std::string& text, std::size_t most = 1000);
/// The row has no id, or one that is too long: refuses the product and gives it a name by its line.
void check_id(Product& product, const std::string& where);

}  // namespace vitrine::input
