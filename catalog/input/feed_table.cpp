// SPDX-License-Identifier: GPL-3.0-or-later
#include "feed_table.hpp"

#include <algorithm>

#include "text.hpp"

namespace vitrine::input {

char FeedTable::separator_of(std::string_view text) {
  char best = ',';
  std::size_t most = 0;
  for (const char separator : {',', '\t', ';'}) {
    csv::Reader reader(text, {separator, true});
    csv::Row row;
    const bool good = reader.next(row);
    if (good && row.fields.size() > most) {
      most = row.fields.size();
      best = separator;
    }
  }
  return best;
}

std::vector<std::string> FeedTable::header_of(std::string_view text, const Rules& rules) {
  csv::Reader reader(text, {separator_of(text), true});
  csv::Row row;
  std::vector<std::string> header;
  if (!reader.next(row)) return header;
  for (const std::string& name : row.fields) {
    std::string plain = plain_column(name);
    const auto ours = rules.columns.find(plain);
    header.push_back(ours == rules.columns.end() ? std::move(plain) : ours->second);
  }
  return header;
}

FeedTable::FeedTable(const std::string& file, std::string_view text, const Rules& rules)
    : file_(file), rules_(rules), reader_(text, {separator_of(text), true}), header_(header_of(text, rules)) {
  reader_.next(row_);  // the header
  for (std::size_t i = 0; i < rules.measures.size(); ++i)
    if (!rules.measures[i].column.empty())
      if (const int at = column({rules.measures[i].column.c_str()}); at >= 0) measures_.emplace_back(i, at);
}

int FeedTable::column(std::initializer_list<const char*> names) const {
  for (const char* name : names) {
    const auto at = std::find(header_.begin(), header_.end(), name);
    if (at != header_.end()) return static_cast<int>(at - header_.begin());
  }
  return -1;
}

bool FeedTable::next() {
  if (error_) return false;
  if (reader_.next(row_)) {
    if (++rows_ <= max_rows) return true;
    error_ =
        bad("FEED_TOO_LARGE", where(), "the feed has more than 1,000,000 rows", "Split it into several catalogues.");
    return false;
  }
  if (!reader_.problem().empty())
    error_ = bad("FEED_CSV", file_ + ":" + std::to_string(reader_.line()), reader_.problem(),
                 "Export the feed again; a field that begins with a quote must end with one.");
  return false;
}

std::string FeedTable::operator[](int column) const {
  const auto at = static_cast<std::size_t>(column);
  return column < 0 || at >= row_.fields.size() ? "" : trimmed(row_.fields[at]);
}

std::string FeedTable::text(int column, std::size_t bytes) const {
  const auto at = static_cast<std::size_t>(column);
  return column < 0 || at >= row_.fields.size() ? "" : one_line(row_.fields[at], bytes);
}

std::optional<Error> FeedTable::row_problem() const {
  if (row_.fields.size() == header_.size()) return {};
  return bad(
      "PRODUCT_ROW", where() + ": column " + std::to_string(std::min(row_.fields.size(), header_.size()) + 1),
      "the row has " + std::to_string(row_.fields.size()) + " fields, the header " + std::to_string(header_.size()),
      "Put fields that contain the separator into quotes, or export the feed again.");
}

std::string FeedTable::where(int column) const {
  if (column < 0) return where();
  return where() + ": column " + std::to_string(column + 1) + " \"" +
         shortened(header_[static_cast<std::size_t>(column)], 60) + "\"";
}

void FeedTable::take_measures(Product& product) const {
  for (const auto& [rule, column] : measures_) {
    std::string value = text(column, 100);
    const bool known = std::any_of(product.columns.begin(), product.columns.end(),
                                   [&, r = rule](const auto& c) { return c.first == r; });
    if (!value.empty() && !known) product.columns.emplace_back(rule, std::move(value));
  }
}

void add_picture(Product& product, const std::string& source, const std::string& alt, int position) {
  if (source.empty()) return;
  for (Picture& known : product.pictures)
    if (known.source == source) {
      if (known.alt.empty()) known.alt = alt;
      return;
    }
  const std::string where = std::to_string(max_pictures);
  if (source.size() > 2048) {
    add_once(product.notes, "a picture's address is longer than 2048 bytes; it is not used");
  } else if (product.pictures.size() >= max_pictures) {
    add_once(product.notes, "only the first " + where + " pictures are looked at");
  } else {
    product.pictures.push_back({source, alt, position});
  }
}

void add_once(std::vector<std::string>& list, const std::string& text, std::size_t most) {
  if (text.empty() || list.size() >= most || std::find(list.begin(), list.end(), text) != list.end()) return;
  list.push_back(text);
}

void check_id(Product& product, const std::string& where) {
  if (!product.id.empty() && product.id.size() <= max_id && !has_control(product.id)) return;
  if (!product.refusal)
    product.refusal =
        bad("PRODUCT_ID", where, product.id.empty() ? "the product has no id" : "the product's id is not usable",
            "Give the product an id of at most 256 bytes.");
  product.id = "line " + std::to_string(product.line);
}

}  // namespace vitrine::input
