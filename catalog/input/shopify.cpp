// SPDX-License-Identifier: GPL-3.0-or-later
// Shopify's product export. Its columns have had two generations of names; a product spans the rows with its handle:
// the first has its texts, each may add a variant and a picture.
#include <algorithm>
#include <charconv>
#include <unordered_map>

#include "feed_table.hpp"
#include "text.hpp"

namespace vitrine::input {
namespace {

constexpr int max_options = 3;

bool is_one_of(const std::string& name, std::initializer_list<const char*> names) {
  const std::string plain = lower(name);
  return std::any_of(names.begin(), names.end(), [&](const char* n) { return plain == n; });
}

struct ShopifyColumns {
  int handle, title, body, category, type, tags, status, sku, picture, position, alt;
  int option_name[max_options], option_value[max_options];
  explicit ShopifyColumns(const FeedTable& t)
      : handle(t.column({"url handle", "handle"})),
        title(t.column({"title"})),
        body(t.column({"description", "body (html)"})),
        category(t.column({"product category", "standardized product type", "standard product type"})),
        type(t.column({"type", "custom product type"})),
        tags(t.column({"tags"})),
        status(t.column({"status"})),
        sku(t.column({"sku", "variant sku"})),
        picture(t.column({"product image url", "image src"})),
        position(t.column({"image position"})),
        alt(t.column({"image alt text"})) {
    for (int i = 0; i < max_options; ++i) {
      const std::string option = "option" + std::to_string(i + 1);
      option_name[i] = t.column({(option + " name").c_str()});
      option_value[i] = t.column({(option + " value").c_str()});
    }
  }
};

/// What is kept of a product while its rows come in.
struct Open {
  std::string option_name[max_options];
  std::vector<std::string> colours;
};

void take_options(const FeedTable& table, const ShopifyColumns& c, Product& product, Open& open) {
  for (int i = 0; i < max_options; ++i) {
    if (std::string name = table.text(c.option_name[i], 100); !name.empty()) open.option_name[i] = std::move(name);
    const std::string value = table.text(c.option_value[i], 100);
    if (is_one_of(open.option_name[i], {"size", "größe", "taille", "talla", "taglia"}))
      add_once(product.sizes, value, 100);
    if (is_one_of(open.option_name[i], {"color", "colour", "farbe", "couleur", "colore"}))
      add_once(open.colours, value, 100);
  }
}

void fill(std::string& text, std::string value) {
  if (text.empty()) text = std::move(value);
}

}  // namespace

Products read_shopify(const std::string& file, std::string_view text, const Rules& rules) {
  FeedTable table(file, text, rules);
  const ShopifyColumns c(table);
  if (c.handle < 0 || c.picture < 0)
    return bad("MANIFEST_COLUMN", file + ":1",
               std::string("a Shopify export has a column \"") + (c.handle < 0 ? "Handle" : "Image Src") + "\" or \"" +
                   (c.handle < 0 ? "URL handle" : "Product image URL") + "\"",
               "Export the products again, or name the columns in the rules' \"columns\".");
  std::vector<Product> products;
  std::vector<Open> open;
  std::unordered_map<std::string, std::size_t> by_handle;
  while (table.next()) {
    std::string handle = table[c.handle];
    const auto problem = table.row_problem();
    Product fresh;
    if (handle.empty() || handle.size() > max_id || has_control(handle)) {
      fresh.id = handle;
      fresh.line = table.line();
      fresh.refusal = problem;
      check_id(fresh, table.where(c.handle));
      products.push_back(std::move(fresh));
      open.emplace_back();
      continue;
    }
    const auto [entry, first] = by_handle.emplace(handle, products.size());
    if (first) {
      fresh.id = fresh.handle = handle;
      fresh.line = table.line();
      products.push_back(std::move(fresh));
      open.emplace_back();
    }
    Product& product = products[entry->second];
    if (problem) {
      // Of several, the first in the file.
      if (!product.refusal) product.refusal = problem;
      continue;
    }
    fill(product.title, table.text(c.title, 1000));
    fill(product.description, table.text(c.body));
    fill(product.category, table.text(c.category));
    fill(product.type, table.text(c.type));
    fill(product.tags, table.text(c.tags));
    fill(product.status, table.text(c.status, 40));
    add_once(product.ids, table.text(c.sku, max_id));
    table.take_measures(product);
    take_options(table, c, product, open[entry->second]);
    const std::string position = table[c.position];
    int number = 0;
    std::from_chars(position.data(), position.data() + position.size(), number);
    add_picture(product, table[c.picture], table.text(c.alt, 512), std::clamp(number, 0, 1'000'000));
  }
  if (table.error()) return *table.error();
  for (std::size_t i = 0; i < products.size(); ++i) {
    Product& product = products[i];
    const std::size_t colours = open[i].colours.size();
    if (colours > 1)
      product.notes.push_back("it has " + std::to_string(colours) +
                              " colours; one garment is made, of the pictures that the rules choose");
    // Pictures stand in the rows in any order; those without a position come after those with one.
    std::stable_sort(product.pictures.begin(), product.pictures.end(), [](const Picture& a, const Picture& b) {
      return (a.position > 0 ? a.position : 1'000'001) < (b.position > 0 ? b.position : 1'000'001);
    });
  }
  return products;
}

}  // namespace vitrine::input
