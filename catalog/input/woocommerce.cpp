// SPDX-License-Identifier: GPL-3.0-or-later
// WooCommerce's product export: a list of pictures for each product, the first its main one. Variations name their
// parent by SKU or as "id:123" and have a picture of their own at most; they are sizes and colours of the parent.
#include <algorithm>
#include <unordered_map>

#include "feed_table.hpp"
#include "text.hpp"

namespace vitrine::input {
namespace {

constexpr int max_attributes = 6;

struct WooColumns {
  int id, type, sku, name, published, short_text, text, categories, tags, pictures, parent;
  int attribute[max_attributes], values[max_attributes];
  explicit WooColumns(const FeedTable& t)
      : id(t.column({"id"})),
        type(t.column({"type"})),
        sku(t.column({"sku"})),
        name(t.column({"name"})),
        published(t.column({"published"})),
        short_text(t.column({"short description"})),
        text(t.column({"description"})),
        categories(t.column({"categories"})),
        tags(t.column({"tags"})),
        pictures(t.column({"images"})),
        parent(t.column({"parent"})) {
    for (int i = 0; i < max_attributes; ++i) {
      const std::string attribute_i = "attribute " + std::to_string(i + 1);
      attribute[i] = t.column({(attribute_i + " name").c_str()});
      values[i] = t.column({(attribute_i + " value(s)").c_str()});
    }
  }
};

void take_attributes(const FeedTable& table, const WooColumns& c, Product& product) {
  for (int i = 0; i < max_attributes; ++i) {
    const std::string name = lower(table.text(c.attribute[i], 100));
    const std::string values = table.text(c.values[i], 2000);
    if (name == "size" || name == "größe" || name == "taille" || name == "talla")
      for (const std::string& size : split(values, ',')) add_once(product.sizes, shortened(size, 100), 100);
    if ((name == "color" || name == "colour" || name == "farbe") && product.color.empty()) product.color = values;
    if ((name == "material" || name == "fabric") && product.material.empty()) product.material = values;
  }
}

}  // namespace

Products read_woocommerce(const std::string& file, std::string_view text, const Rules& rules) {
  FeedTable table(file, text, rules);
  const WooColumns c(table);
  if (c.pictures < 0 || (c.sku < 0 && c.id < 0))
    return bad("MANIFEST_COLUMN", file + ":1",
               std::string("a WooCommerce export has a column \"") + (c.pictures < 0 ? "Images" : "SKU") + "\"",
               "Export the products again, or name the columns in the rules' \"columns\".");
  struct Variation {
    Product product;
    std::string parent;
  };
  std::vector<Product> products;
  std::vector<Variation> variations;
  std::unordered_map<std::string, std::size_t> by_name;  // SKU and "id:123"
  while (table.next()) {
    Product product;
    product.line = table.line();
    product.refusal = table.row_problem();
    const std::string number = table[c.id], sku = table[c.sku];
    product.id = sku.empty() && !number.empty() ? "id " + number : sku;
    check_id(product, table.where(c.sku >= 0 ? c.sku : c.id));
    product.title = table.text(c.name, 1000);
    product.description = one_line(table.text(c.short_text) + " " + table.text(c.text), max_field);
    product.category = table.text(c.categories);
    product.tags = table.text(c.tags);
    const std::string published = table[c.published];
    product.status = published == "0" ? "private" : published == "-1" ? "draft" : "";
    add_once(product.ids, shortened(product.id, max_id));
    take_attributes(table, c, product);
    table.take_measures(product);
    int position = 0;
    for (const std::string& source : split(table[c.pictures], ',')) add_picture(product, source, "", ++position);
    const std::string type = lower(table[c.type]);
    const bool variation = type.rfind("variation", 0) == 0 || type.find(", variation") != std::string::npos;
    if (variation && !product.refusal) {
      variations.push_back({std::move(product), table[c.parent]});
      continue;
    }
    if (!sku.empty()) by_name.emplace(sku, products.size());
    if (!number.empty()) by_name.emplace("id:" + number, products.size());
    products.push_back(std::move(product));
  }
  if (table.error()) return *table.error();

  for (Variation& v : variations) {
    const auto parent = by_name.find(v.parent);
    Product& p = v.product;
    if (parent == by_name.end()) {
      p.refusal = bad("PRODUCT_ROW", file + ":" + std::to_string(p.line) + ": column \"parent\"",
                      "the variation \"" + one_line(p.id, 80) + "\" has a parent that is not in the file: \"" +
                          one_line(v.parent, 80) + "\"",
                      "Export parents and variations together.");
      products.push_back(std::move(p));
      continue;
    }
    Product& whole = products[parent->second];
    const auto plan = choose_pictures(p, rules);
    const auto has = [&](const char* role) {
      return std::any_of(plan.begin(), plan.end(), [&](const PicturePlan& picture) { return picture.role == role; });
    };
    if (p.pictures.size() > 1 && has("front") && has("back")) {
      // A colour photographed from both sides is a garment of its own, filed like its parent.
      for (auto member : {&Product::title, &Product::category, &Product::tags, &Product::description,
                          &Product::material, &Product::status})
        if ((p.*member).empty()) p.*member = whole.*member;
      products.push_back(std::move(p));
      continue;
    }
    for (const std::string& id : p.ids) add_once(whole.ids, id);
    for (const std::string& size : p.sizes) add_once(whole.sizes, size, 100);
    for (const auto& column : p.columns) whole.columns.push_back(column);
  }
  // In the order of the file, wherever a variation's own garment was put.
  std::stable_sort(products.begin(), products.end(),
                   [](const Product& a, const Product& b) { return a.line < b.line; });
  return products;
}

}  // namespace vitrine::input
