// SPDX-License-Identifier: GPL-3.0-or-later
#include <unordered_map>

#include "json_text.hpp"
#include "manifest_fields.hpp"

namespace vitrine::input {
namespace {

using nlohmann::json;

/// A value as the CSV would have it; empty optional for what no column takes.
std::optional<std::string> as_text(const json& value, const std::string& name) {
  if (value.is_string()) return trimmed(value.get_ref<const std::string&>());
  if (value.is_null()) return "";
  if (value.is_boolean() && name == "mirror_back") return value.get<bool>() ? "yes" : "no";
  if (value.is_number() && (name == "chest_cm" || name == "length_cm")) return value.dump();
  if (value.is_array() && name == "mannequin") {
    std::string all;
    for (const json& size : value) {
      if (!size.is_string() || size.get_ref<const std::string&>().find(' ') != std::string::npos) return {};
      all += (all.empty() ? "" : " ") + size.get<std::string>();
    }
    return all;
  }
  return {};
}

}  // namespace

Result<std::vector<CatalogItem>> read_json_manifest(const std::string& path, std::string_view text,
                                                    std::vector<std::string>& warnings) {
  std::vector<int> lines;
  Result<json> parsed = parse_json(text, path, "MANIFEST_JSON", &lines);
  if (!parsed) return parsed.error();
  const bool wrapped = parsed->is_object() && parsed->contains("items");
  const json& list = wrapped ? (*parsed)["items"] : *parsed;
  if (!list.is_array())
    return bad("MANIFEST_JSON", path + ":1", "there is no list of items",
               "Write a list of objects, or an object with the list as \"items\".");
  if (list.size() > max_rows)
    return bad("MANIFEST_TOO_LARGE", path, "the manifest has more than 1,000,000 items",
               "Split it into several catalogues.");
  if (wrapped)
    for (const auto& [name, value] : parsed->items())
      if (name != "items" && value.is_structured())
        return bad("MANIFEST_JSON", path + ": \"" + shortened(name, 60) + "\"", "not a key of a manifest",
                   "Remove it.");
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::vector<CatalogItem> items;
  items.reserve(list.size());
  std::unordered_map<std::string, int> seen;
  // Items have no objects inside them, so the objects begin in the items' order, after the one around them.
  std::size_t object = wrapped ? 1 : 0;
  for (const json& entry : list) {
    const std::string number = "item " + std::to_string(items.size() + 1);
    if (!entry.is_object())
      return bad("MANIFEST_JSON", path + ": " + number, "this is not an object",
                 "Write {\"sku\": ..., \"garment\": ..., \"front\": ...}.");
    const int line = object < lines.size() ? lines[object++] : 0;
    const std::string where = path + ":" + std::to_string(line) + ": " + number;
    CatalogItem item;
    item.line = line;
    for (const char* name : mandatory_columns)
      if (!entry.contains(name))
        return bad("MANIFEST_COLUMN", where + ": \"" + name + "\"", "the item has no such key",
                   "sku, garment and front are needed.");
    ManifestField field;
    for (const auto& [name, value] : entry.items()) {
      field.name = name;
      field.where = ": \"" + shortened(name, 60) + "\"";
      const auto setter = manifest_setters().find(name);
      if (setter == manifest_setters().end()) {
        if (value.is_structured())
          return bad("MANIFEST_JSON", where + field.where, "not a key of a manifest", "Remove it.");
        if (warnings.size() < 20) warnings.push_back(where + field.where + ": not a key of a manifest; it is ignored.");
        continue;
      }
      const auto said = as_text(value, name);
      if (!said)
        return bad("MANIFEST_VALUE", where + field.where, "the value is of a kind that this key does not take",
                   "Write a text; numbers for chest_cm and length_cm, true or false for mirror_back, a list of sizes "
                   "for mannequin.");
      field.value = *said;
      if (auto error = set_field(setter->second, field, folder, item)) {
        error->message.insert(0, where);
        return *error;
      }
    }
    const auto [first, fresh] = seen.emplace(item.sku, line);
    if (!fresh)
      return bad("SKU_DUPLICATE", where + ": \"sku\"",
                 "\"" + item.sku + "\" is also the sku of line " + std::to_string(first->second),
                 "Give each item a sku of its own.");
    if (auto error = check_back(item, [&](const char* name) { return where + ": \"" + name + "\""; })) return *error;
    items.push_back(std::move(item));
  }
  if (items.empty())
    return bad("MANIFEST_EMPTY", path, "the manifest lists no items", "Write an object for each item.");
  return items;
}

}  // namespace vitrine::input
