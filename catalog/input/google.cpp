// SPDX-License-Identifier: GPL-3.0-or-later
#include "google.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "feed_table.hpp"
#include "text.hpp"

namespace vitrine::input {

bool take_google_attribute(GoogleRow& row, std::string_view name, const std::string& value) {
  Product& p = row.product;
  const auto into = [&](std::string& text, std::size_t bytes) {
    if (text.empty()) text = one_line(value, bytes);
    return true;
  };
  if (name == "id") {
    if (p.id.empty()) p.id = trimmed(value);
    return true;
  }
  if (name == "title") return into(p.title, 1000);
  if (name == "description") return into(p.description, max_field);
  if (name == "google product category") return into(p.category, 1000);
  if (name == "product type") return into(p.type, 1000);
  if (name == "color") return into(p.color, 200);
  if (name == "gender") return into(p.gender, 40);
  if (name == "material") return into(p.material, 400);
  if (name == "item group id") return into(row.group, max_id);
  if (name == "size") {
    add_once(p.sizes, one_line(value, 100));
    return true;
  }
  if (name == "image link") {
    add_picture(p, trimmed(value), "", 1);
    return true;
  }
  if (name == "additional image link") {
    // Of a repeated attribute each is one address, in a table they are separated by commas: %2C is a comma in either.
    for (const std::string& source : split(value, ','))
      add_picture(p, source, "", static_cast<int>(std::max<std::size_t>(p.pictures.size(), 1)) + 1);
    return true;
  }
  return false;
}

std::vector<Product> merge_google_rows(std::vector<GoogleRow> rows, const std::string& file) {
  // An id that appears twice: which of the two is meant, only the shop knows.
  std::unordered_map<std::string, int> first_line;
  for (GoogleRow& row : rows) {
    Product& p = row.product;
    const std::string where = file + ":" + std::to_string(p.line);
    check_id(p, where + ": \"id\"");
    const auto [known, fresh] = first_line.emplace(p.id, p.line);
    if (!fresh && !p.refusal) {
      p.refusal = bad("PRODUCT_ID", where + ": \"id\"",
                      "\"" + one_line(p.id, 80) + "\" is also the id of line " + std::to_string(known->second),
                      "Give each product an id of its own.");
      p.id += " (line " + std::to_string(p.line) + ")";
    }
    p.ids = {p.id};
  }
  std::map<std::string, std::map<std::string, std::vector<std::size_t>>> groups;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!rows[i].group.empty() && !rows[i].product.refusal)
      groups[rows[i].group][lower(rows[i].product.color)].push_back(i);

  std::vector<bool> merged(rows.size(), false);
  for (auto& [group, colours] : groups)
    for (auto& [colour, members] : colours) {
      const auto head = *std::min_element(members.begin(), members.end(), [&](std::size_t a, std::size_t b) {
        return rows[a].product.id < rows[b].product.id;
      });
      // It stands where the first of them stood.
      const std::size_t place = members.front();
      std::sort(members.begin(), members.end(),
                [&](std::size_t a, std::size_t b) { return rows[a].product.id < rows[b].product.id; });
      Product whole = rows[head].product;
      whole.ids.clear();
      whole.sizes.clear();
      const auto sources = [&](std::size_t i) {
        std::vector<std::string> all;
        for (const Picture& picture : rows[i].product.pictures) all.push_back(picture.source);
        return all;
      };
      const auto of_head = sources(head);
      for (const std::size_t i : members) {
        const Product& p = rows[i].product;
        whole.ids.push_back(p.id);
        for (const std::string& size : p.sizes) add_once(whole.sizes, size, 100);
        for (const auto& column : p.columns)
          if (std::none_of(whole.columns.begin(), whole.columns.end(),
                           [&](const auto& c) { return c.first == column.first; }))
            whole.columns.push_back(column);
        if (sources(i) != of_head)
          add_once(whole.notes, "the rows of this garment have not all the same pictures; those of " +
                                    one_line(whole.id, 80) + " are used");
        merged[i] = i != place;
      }
      whole.id = group + (colours.size() > 1 && !colour.empty() ? " " + colour : "");
      whole.line = rows[place].product.line;
      rows[place].product = std::move(whole);
    }

  // A group may be called like a product of its own, or like another group and colour.
  std::vector<Product> products;
  std::unordered_map<std::string, int> named;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (merged[i]) continue;
    Product& p = rows[i].product;
    ++named[p.id];
    products.push_back(std::move(p));
  }
  for (Product& p : products)
    if (named[p.id] > 1) p.id = p.ids.empty() ? p.id : *std::min_element(p.ids.begin(), p.ids.end());
  return products;
}

Products read_google_table(const std::string& file, std::string_view text, const Rules& rules) {
  FeedTable table(file, text, rules);
  const std::vector<std::string> header = FeedTable::header_of(text, rules);
  for (const char* name : {"id", "image link"})
    if (table.column({name}) < 0)
      return bad("MANIFEST_COLUMN", file + ":1", std::string("a Google product feed has a column \"") + name + "\"",
                 "Export the feed again, or name the columns in the rules' \"columns\".");
  std::vector<GoogleRow> rows;
  while (table.next()) {
    GoogleRow row;
    row.product.line = table.line();
    row.product.refusal = table.row_problem();
    for (std::size_t i = 0; i < header.size(); ++i)
      if (const std::string value = table[static_cast<int>(i)]; !value.empty())
        take_google_attribute(row, header[i], value);
    table.take_measures(row.product);
    rows.push_back(std::move(row));
  }
  if (table.error()) return *table.error();
  return merge_google_rows(std::move(rows), file);
}

}  // namespace vitrine::input
