// SPDX-License-Identifier: GPL-3.0-or-later
#include <charconv>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "csv.hpp"
#include "read_input.hpp"
#include "text.hpp"
#include "vitrine/catalog_input.hpp"

namespace vitrine {
namespace {

namespace fs = std::filesystem;

using Fields = std::vector<std::pair<const char*, std::string>>;

std::string number(const std::optional<double>& value) {
  if (!value) return "";
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, *value).ptr};
}

/// The photo from the manifest's folder where it lies below it, else its whole path.
std::string from_folder(const std::string& photo, const fs::path& folder) {
  if (photo.empty()) return "";
  const std::string whole = fs::absolute(photo).lexically_normal().string();
  std::string start = folder.string();
  if (start.empty() || start.back() != '/') start += '/';
  if (whole.compare(0, start.size(), start) != 0) return whole;
  const std::string rest = whole.substr(start.size());
  return rest.empty() || rest[0] == ' ' || rest[0] == '\t' ? "./" + rest : rest;
}

Fields fields_of(const CatalogItem& item, const fs::path& folder) {
  std::string sizes;
  for (const std::string& who : item.mannequins) sizes += (sizes.empty() ? "" : " ") + who;
  return {{"sku", item.sku},
          {"garment", item.garment},
          {"neckline", item.neckline},
          {"front", from_folder(item.front, folder)},
          {"back", from_folder(item.back, folder)},
          {"mirror_back", item.mirror_back ? "yes" : ""},
          {"front_mask", from_folder(item.front_mask, folder)},
          {"back_mask", from_folder(item.back_mask, folder)},
          {"chest_cm", number(item.chest_cm)},
          {"length_cm", number(item.length_cm)},
          {"fabric", item.fabric},
          {"mannequin", sizes},
          {"title", item.title},
          {"copyright", item.copyright},
          {"product_id", item.product_id}};
}

/// What a reader would take for something else: blanks at an end are layout, and names with control characters are
/// refused.
std::optional<Error> check(const Fields& fields, const std::string& path) {
  for (const auto& [name, value] : fields) {
    const bool photo = std::string(name).find("front") == 0 || std::string(name).find("back") == 0;
    const bool safe = value == input::trimmed(value) && value.size() <= input::max_field &&
                      (!photo || !input::has_control(value)) && csv::utf8_length(value) == value.size() &&
                      value.find('\0') == std::string::npos;
    if (!safe)
      return input::bad("MANIFEST_VALUE", path + ": sku \"" + fields[0].second + "\": \"" + name + "\"",
                        "a manifest cannot hold this value", "Rename the file, or shorten the text.");
  }
  return {};
}

}  // namespace

Result<std::string> input::manifest_text(const std::vector<CatalogItem>& items, const std::string& path) {
  const fs::path folder = fs::absolute(path).lexically_normal().parent_path();
  const bool json = input::lower(fs::path(path).extension().string()) == ".json";
  std::string text;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const CatalogItem& item : items) {
    if (item.refusal) continue;
    const Fields fields = fields_of(item, folder);
    if (auto error = check(fields, path)) return *error;
    if (json) {
      nlohmann::ordered_json entry;
      for (const auto& [name, value] : fields)
        if (!value.empty()) entry[name] = value;
      if (item.chest_cm) entry["chest_cm"] = *item.chest_cm;
      if (item.length_cm) entry["length_cm"] = *item.length_cm;
      if (item.mirror_back) entry["mirror_back"] = true;
      if (!item.mannequins.empty()) entry["mannequin"] = item.mannequins;
      list.push_back(std::move(entry));
      continue;
    }
    std::string line;
    if (text.empty()) {
      for (const auto& [name, value] : fields) line += (line.empty() ? "" : ",") + std::string(name);
      line += '\n';
    }
    for (std::size_t i = 0; i < fields.size(); ++i) line += (i > 0 ? "," : "") + csv::quoted(fields[i].second);
    text += line + "\n";
  }
  if (json) text = nlohmann::ordered_json{{"items", std::move(list)}}.dump(1) + "\n";
  return text;
}

std::optional<Error> write_manifest(const std::vector<CatalogItem>& items, const std::string& path) {
  const Result<std::string> text = input::manifest_text(items, path);
  if (!text) return text.error();
  const fs::path folder = fs::absolute(path).lexically_normal().parent_path();
  const fs::path temporary = folder / ("." + fs::path(path).filename().string() + "~");
  std::ofstream out(temporary, std::ios::binary);
  out << *text;
  out.close();
  std::error_code failed;
  if (out) fs::rename(temporary, path, failed);
  if (out && !failed) return {};
  std::error_code ignored;
  fs::remove(temporary, ignored);
  return Error{Cause::unwritable, "MANIFEST_WRITE", path + ": the file cannot be written",
               "Free some space, or choose another folder.", "catalog"};
}

}  // namespace vitrine
