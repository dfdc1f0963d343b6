// SPDX-License-Identifier: GPL-3.0-or-later
// A folder of photos: SKU_front.jpg and SKU_back.jpg, or SKU/front.jpg and SKU/back.jpg. A folder around them says what
// kind of garment they are (skirts/denim-mini_front.jpg), as the type of a product does in a feed.
#include <re2/re2.h>

#include <algorithm>
#include <map>

#include "image_root.hpp"
#include "rules.hpp"
#include "text.hpp"

namespace vitrine::input {
namespace {

/// The name without what the rule matched, and without the marks before that.
std::string without(const std::string& stem, std::size_t matched_letters) {
  std::string name = stem;
  // Words of the slug and of the stem end at the same places counted from the right: letters and digits.
  while (matched_letters > 0 && !name.empty()) {
    if (is_word(name.back())) --matched_letters;
    name.pop_back();
  }
  while (!name.empty() && !is_word(name.back())) name.pop_back();
  return name;
}

std::size_t letters(std::string_view words) {
  return words.size() - static_cast<std::size_t>(std::count(words.begin(), words.end(), '-'));
}

}  // namespace

Products read_folder(const ImageRoot& root, const Rules& rules, std::vector<std::string>& warnings) {
  std::map<std::string, Product> products;
  std::size_t unnamed = 0;
  std::string example;
  for (const std::string& path : root.files()) {
    if (!is_picture(path)) continue;
    const auto slash = path.rfind('/');
    const std::string parent = slash == std::string::npos ? "" : path.substr(0, slash);
    const std::string stem = stem_of(path, rules);
    const std::string words = slug(stem);
    // Which part of the name says what the picture is; positions mean nothing in a folder.
    std::size_t said = 0;
    for (std::size_t g = 0; g < rules.pictures.size() && said == 0; ++g)
      for (const PictureRule& rule : rules.pictures[g]) {
        if (rule.field != PictureRule::Field::file) continue;
        const re2::StringPiece text(words);
        re2::StringPiece hit;
        if (!rule.match->Match(text, 0, words.size(), re2::RE2::UNANCHORED, &hit, 1)) continue;
        said = letters(std::string_view(words).substr(static_cast<std::size_t>(hit.data() - text.data())));
        break;
      }
    if (said == 0) {
      if (++unnamed == 1) example = path;
      continue;
    }
    std::string sku = without(stem, said), type = parent;
    if (sku.empty()) {
      const auto last = parent.rfind('/');
      sku = last == std::string::npos ? parent : parent.substr(last + 1);
      type = last == std::string::npos ? "" : parent.substr(0, last);
    }
    if (sku.empty()) sku = stem;  // front.jpg in the folder itself
    // Two folders may have the same name in two others: then the path is the name.
    Product& product = products[type + "\n" + sku];
    product.id = product.title = one_line(sku, max_id);
    product.type = one_line(type, 1000);
    std::replace(product.type.begin(), product.type.end(), '/', ' ');
    add_picture(product, path, "", 0);
  }
  if (unnamed > 0)
    warnings.push_back(root.folder() + ": " + std::to_string(unnamed) +
                       " pictures have no front or back in their name, such as " + one_line(example, 200) +
                       "; they are passed over.");
  std::map<std::string, int> named;
  for (const auto& [key, product] : products) ++named[product.id];
  std::vector<Product> list;
  for (auto& [key, product] : products) {
    if (named[product.id] > 1)
      product.id = one_line(product.type.empty() ? product.id : product.type + " " + product.id, max_id);
    product.ids = {product.id};
    // A garment of a SKU's own words ("skirt-denim") is read from the title, in which words are apart.
    std::string words = slug(product.title);
    std::replace(words.begin(), words.end(), '-', ' ');
    product.tags = words;
    std::string type_words = slug(product.type);
    std::replace(type_words.begin(), type_words.end(), '-', ' ');
    product.type = type_words;
    list.push_back(std::move(product));
  }
  return list;
}

}  // namespace vitrine::input
