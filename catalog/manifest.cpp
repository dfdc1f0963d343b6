// SPDX-License-Identifier: GPL-3.0-or-later
#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "csv.hpp"
#include "sku.hpp"
#include "vitrine/catalog.hpp"

namespace vitrine {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t max_bytes = 64u << 20;
constexpr std::size_t max_rows = 1'000'000;
constexpr std::size_t max_field = 4096;

Error bad(const char* code, const std::string& where, const std::string& what, const std::string& remedy) {
  return Error{Cause::unusable, code, where + ": " + what, remedy, "catalog"};
}

std::string lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// One field on its way into an item: where it stands, for messages, and what it says.
struct Field {
  const std::string& file;
  int line;
  std::size_t column;
  const std::string& name;
  const std::string value;
  std::string where() const {
    return file + ":" + std::to_string(line) + ": column " + std::to_string(column + 1) + " \"" + name + "\"";
  }
};

using Setter = std::optional<Error> (*)(const Field&, const fs::path& folder, CatalogItem&);

template <std::string CatalogItem::*member>
std::optional<Error> set_text(const Field& f, const fs::path&, CatalogItem& item) {
  item.*member = f.value;
  return {};
}

template <std::string CatalogItem::*member>
std::optional<Error> set_path(const Field& f, const fs::path& folder, CatalogItem& item) {
  if (f.value.empty()) return {};
  if (std::any_of(f.value.begin(), f.value.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
    return bad("MANIFEST_VALUE", f.where(), "the file name has a control character in it",
               "Write the plain name of the photo.");
  item.*member = (folder / f.value).lexically_normal().string();
  return {};
}

template <std::optional<double> CatalogItem::*member>
std::optional<Error> set_cm(const Field& f, const fs::path&, CatalogItem& item) {
  if (f.value.empty()) return {};
  double number = 0;
  const char* end = f.value.data() + f.value.size();
  const auto [rest, failed] = std::from_chars(f.value.data(), end, number);
  if (failed != std::errc() || rest != end || !std::isfinite(number) || number < 5 || number > 300)
    return bad("MANIFEST_VALUE", f.where(), "\"" + f.value.substr(0, 40) + "\" is not a length between 5 and 300",
               "Write centimetres with a decimal point, such as 46.5, or leave it empty.");
  item.*member = number;
  return {};
}

std::optional<Error> set_mirror(const Field& f, const fs::path&, CatalogItem& item) {
  const std::string v = lower(f.value);
  if (v.empty()) return {};
  if (v != "yes" && v != "no" && v != "true" && v != "false" && v != "1" && v != "0")
    return bad("MANIFEST_VALUE", f.where(), "\"" + f.value.substr(0, 40) + "\" is neither yes nor no",
               "Write yes (make the back from the front's silhouette) or no, or leave it empty for no.");
  item.mirror_back = v == "yes" || v == "true" || v == "1";
  return {};
}

std::optional<Error> set_neckline(const Field& f, const fs::path&, CatalogItem& item) {
  if (!f.value.empty()) item.neckline = f.value;
  return {};
}

const std::map<std::string, Setter>& setters() {
  static const std::map<std::string, Setter> all{{"sku", set_text<&CatalogItem::sku>},
                                                 {"garment", set_text<&CatalogItem::garment>},
                                                 {"neckline", set_neckline},
                                                 {"front", set_path<&CatalogItem::front>},
                                                 {"back", set_path<&CatalogItem::back>},
                                                 {"mirror_back", set_mirror},
                                                 {"front_mask", set_path<&CatalogItem::front_mask>},
                                                 {"back_mask", set_path<&CatalogItem::back_mask>},
                                                 {"chest_cm", set_cm<&CatalogItem::chest_cm>},
                                                 {"length_cm", set_cm<&CatalogItem::length_cm>},
                                                 {"fabric", set_text<&CatalogItem::fabric>},
                                                 {"title", set_text<&CatalogItem::title>},
                                                 {"copyright", set_text<&CatalogItem::copyright>}};
  return all;
}

constexpr const char* mandatory[] = {"sku", "garment", "front"};

struct Header {
  std::vector<std::string> names;
  std::vector<Setter> setter;  ///< null where the column is not known
};

Result<Header> read_header(const std::string& file, const csv::Row& row, std::vector<std::string>& warnings) {
  Header header;
  const std::string where = file + ":" + std::to_string(row.line);
  for (const std::string& field : row.fields) {
    const std::string name = lower(trimmed(field));
    const std::string column =
        where + ": column " + std::to_string(header.names.size() + 1) + " \"" + name.substr(0, 60) + "\"";
    const auto found = setters().find(name);
    if (found != setters().end() && std::find(header.names.begin(), header.names.end(), name) != header.names.end())
      return bad("MANIFEST_COLUMN", column, "the column appears twice", "Keep one column of this name.");
    if (found == setters().end()) warnings.push_back(column + ": not a column of a manifest; it is ignored.");
    header.names.push_back(name);
    header.setter.push_back(found == setters().end() ? nullptr : found->second);
  }
  for (const char* name : mandatory)
    if (std::find(header.names.begin(), header.names.end(), name) == header.names.end()) {
      const bool semicolons = header.names.size() == 1 && row.fields[0].find(';') != std::string::npos;
      return bad("MANIFEST_COLUMN", where + ": column \"" + name + "\"", "the manifest has no such column",
                 semicolons ? "The columns seem to be separated by semicolons: save the file as CSV with commas."
                            : "The first row must name the columns; sku, garment and front are needed.");
    }
  return header;
}

/// The back comes from a photo or from the mirrored front: a row must say which, and not both.
std::optional<Error> check_back(const std::string& where, const Header& header, const CatalogItem& item) {
  const auto column = [&](const std::string& name) {
    const auto at = std::find(header.names.begin(), header.names.end(), name);
    const std::string number = at == header.names.end() ? "" : " " + std::to_string(at - header.names.begin() + 1);
    return where + ": column" + number + " \"" + name + "\"";
  };
  if (item.back.empty() && !item.mirror_back)
    return bad("MANIFEST_VALUE", column("back"), "there is neither a back photo nor mirror_back",
               "Name the back photo, or write yes in mirror_back to make the back from the front's silhouette.");
  if (!item.back.empty() && item.mirror_back)
    return bad("MANIFEST_VALUE", column("mirror_back"), "the row has a back photo, and mirror_back says to do without",
               "Leave mirror_back empty to use the photo, or leave back empty.");
  if (!item.back_mask.empty() && item.mirror_back)
    return bad("MANIFEST_VALUE", column("back_mask"), "a mask of the back without a back photo",
               "Leave back_mask empty, or name the back photo and leave mirror_back empty.");
  return {};
}

Result<std::string> read_text(const std::string& path) {
  std::error_code failed;
  const auto missing = [&](const std::string& why) {
    return Error{Cause::missing, "MANIFEST_MISSING", path + ": " + why,
                 "Check the name of the manifest and its permissions.", "catalog"};
  };
  const fs::file_status status = fs::status(path, failed);
  if (!fs::exists(status)) return missing("there is no such file");
  if (!fs::is_regular_file(status)) return missing("this is not a file");
  const auto size = fs::file_size(path, failed);
  if (failed) return missing(failed.message());
  if (size > max_bytes)
    return bad("MANIFEST_TOO_LARGE", path, "the file has more than 64 MB", "Split it into several catalogues.");
  std::ifstream in(path, std::ios::binary);
  std::string text(size, '\0');
  in.read(text.data(), static_cast<std::streamsize>(size));
  if (!in) return missing("the file cannot be read");
  return text;
}

}  // namespace

Result<std::vector<CatalogItem>> read_manifest(const std::string& path, std::vector<std::string>* warnings) {
  const Result<std::string> read = read_text(path);
  if (!read) return read.error();
  std::string_view text = *read;
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  if (!csv::is_utf8(text) || text.find('\0') != std::string_view::npos)
    return bad("MANIFEST_ENCODING", path, "the text is not UTF-8", "Save the file as \"CSV UTF-8\".");
  const fs::path folder = fs::path(path).parent_path();

  csv::Reader reader(text);
  csv::Row row;
  std::vector<std::string> notes;
  Header header;
  if (reader.next(row)) {
    Result<Header> named = read_header(path, row, notes);
    if (!named) return named.error();
    header = std::move(*named);
  }
  std::vector<CatalogItem> items;
  std::map<std::string, int> seen;
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
      const Field field{path, row.line, i, header.names[i], trimmed(row.fields[i])};
      if (field.value.size() > max_field)
        return bad("MANIFEST_VALUE", field.where(), "the field is longer than 4096 bytes", "Shorten it.");
      if (std::find(std::begin(mandatory), std::end(mandatory), field.name) != std::end(mandatory) &&
          field.value.empty())
        return bad("MANIFEST_VALUE", field.where(), "the field is empty", "Fill it in, or delete the row.");
      if (std::optional<Error> error = header.setter[i](field, folder, item)) return *error;
      if (field.name != "sku") continue;
      if (!is_safe_sku(field.value))
        return bad("SKU_UNSAFE", field.where(), "\"" + field.value.substr(0, 110) + "\" cannot be the name of a folder",
                   "Use at most 100 of the characters A-Z a-z 0-9 . _ - and do not begin with . or -");
      const auto [first, fresh] = seen.emplace(field.value, row.line);
      if (!fresh)
        return bad("SKU_DUPLICATE", field.where(),
                   "\"" + field.value + "\" is also the sku of line " + std::to_string(first->second),
                   "Give each row a sku of its own.");
    }
    if (std::optional<Error> error = check_back(where, header, item)) return *error;
    items.push_back(std::move(item));
  }
  if (!reader.problem().empty())
    return bad("MANIFEST_CSV", path + ":" + std::to_string(reader.line()), reader.problem(),
               "Put the whole field into quotes and write a quote inside it twice.");
  if (items.empty())
    return bad("MANIFEST_EMPTY", path, "the manifest lists no items",
               "Write a row of column names and a row for each item.");
  if (warnings != nullptr)
    *warnings = std::move(notes);
  else
    for (const std::string& note : notes) spdlog::warn("{}", note);
  return items;
}

}  // namespace vitrine
