// SPDX-License-Identifier: GPL-3.0-or-later
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <unordered_map>

#include "csv.hpp"
#include "manifest_fields.hpp"
#include "text.hpp"
#include "vitrine/catalog.hpp"

namespace vitrine {
namespace input {
namespace {

namespace fs = std::filesystem;

struct Header {
  std::vector<std::string> names;
  std::vector<std::string> places;  ///< for messages: ": column 2 \"garment\""
  std::vector<Setter> setter;       ///< null where the column is not known
};

Result<Header> read_header(const std::string& file, const csv::Row& row, std::vector<std::string>& warnings) {
  Header header;
  const std::string where = file + ":" + std::to_string(row.line);
  for (const std::string& field : row.fields) {
    const std::string name = lower(trimmed(field));
    const std::string place =
        ": column " + std::to_string(header.names.size() + 1) + " \"" + shortened(name, 60) + "\"";
    const std::string column = where + place;
    const auto found = manifest_setters().find(name);
    const bool known = found != manifest_setters().end();
    if (known && std::find(header.names.begin(), header.names.end(), name) != header.names.end())
      return bad("MANIFEST_COLUMN", column, "the column appears twice", "Keep one column of this name.");
    if (!known) warnings.push_back(column + ": not a column of a manifest; it is ignored.");
    header.names.push_back(name);
    header.places.push_back(place);
    header.setter.push_back(known ? found->second : nullptr);
  }
  for (const char* name : mandatory_columns)
    if (std::find(header.names.begin(), header.names.end(), name) == header.names.end()) {
      const bool semicolons = header.names.size() == 1 && row.fields[0].find(';') != std::string::npos;
      return bad("MANIFEST_COLUMN", where + ": column \"" + name + "\"", "the manifest has no such column",
                 semicolons ? "The columns seem to be separated by semicolons: save the file as CSV with commas."
                            : "The first row must name the columns; sku, garment and front are needed.");
    }
  return header;
}

}  // namespace

Result<std::vector<CatalogItem>> read_csv_manifest(const std::string& path, std::string_view text,
                                                   std::vector<std::string>& warnings) {
  if (auto error = check_utf8(text, path, "MANIFEST_ENCODING")) return *error;
  const fs::path folder = fs::path(path).parent_path();
  csv::Reader reader(text);
  csv::Row row;
  Header header;
  if (reader.next(row)) {
    Result<Header> named = read_header(path, row, warnings);
    if (!named) return named.error();
    header = std::move(*named);
  }
  const auto where_of = [&](int line, const std::string& name) {
    const auto at = std::find(header.names.begin(), header.names.end(), name);
    const std::string number = at == header.names.end() ? "" : " " + std::to_string(at - header.names.begin() + 1);
    return path + ":" + std::to_string(line) + ": column" + number + " \"" + name + "\"";
  };
  std::vector<CatalogItem> items;
  std::unordered_map<std::string, int> seen;
  ManifestField field;
  while (reader.problem().empty() && reader.next(row)) {
    const std::string where = path + ":" + std::to_string(row.line);
    if (items.size() >= max_rows)
      return bad("MANIFEST_TOO_LARGE", where, "the manifest has more than 1,000,000 rows",
                 "Split it into several catalogues.");
    if (row.fields.size() != header.names.size())
      return bad("MANIFEST_CSV",
                 where + ": column " + std::to_string(std::min(row.fields.size(), header.names.size()) + 1),
                 "the row has " + std::to_string(row.fields.size()) + " fields, the header " +
                     std::to_string(header.names.size()),
                 "Put fields that contain commas into quotes, and write a comma for each empty field.");
    CatalogItem item;
    item.line = row.line;
    for (std::size_t i = 0; i < row.fields.size(); ++i) {
      if (header.setter[i] == nullptr) continue;
      field.where = header.places[i];
      field.name = header.names[i];
      field.value = trimmed(row.fields[i]);
      if (auto error = set_field(header.setter[i], field, folder, item)) {
        error->message.insert(0, where);
        return *error;
      }
    }
    const auto [first, fresh] = seen.emplace(item.sku, row.line);
    if (!fresh)
      return bad("SKU_DUPLICATE", where_of(row.line, "sku"),
                 "\"" + item.sku + "\" is also the sku of line " + std::to_string(first->second),
                 "Give each row a sku of its own.");
    if (auto error = check_back(item, [&](const char* name) { return where_of(row.line, name); })) return *error;
    items.push_back(std::move(item));
  }
  if (!reader.problem().empty())
    return bad("MANIFEST_CSV", path + ":" + std::to_string(reader.line()), reader.problem(),
               "Put the whole field into quotes and write a quote inside it twice.");
  if (items.empty())
    return bad("MANIFEST_EMPTY", path, "the manifest lists no items",
               "Write a row of column names and a row for each item.");
  return items;
}

}  // namespace input

Result<std::vector<CatalogItem>> read_manifest(const std::string& path, std::vector<std::string>* warnings) {
  const Result<std::string> text = input::read_text(path, input::max_manifest_bytes, "MANIFEST_TOO_LARGE");
  if (!text) return text.error();
  std::vector<std::string> notes;
  auto items = input::read_csv_manifest(path, *text, notes);
  if (!items) return items;
  if (warnings != nullptr)
    *warnings = std::move(notes);
  else
    for (const std::string& note : notes) spdlog::warn("{}", note);
  return items;
}

}  // namespace vitrine
