// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "text.hpp"
#include "vitrine/catalog.hpp"

namespace vitrine::input {

/// One field on its way into an item: where it stands, for messages, and what it says, trimmed.
struct ManifestField {
  std::string where;  ///< for messages: column or key; the caller puts file and line before it
  std::string name;
  std::string value;
};

/// Checks the field and puts it into the item; `folder` is where relative paths begin.
using Setter = std::optional<Error> (*)(const ManifestField&, const std::filesystem::path& folder, CatalogItem&);

/// The columns of a manifest by name.
const std::map<std::string, Setter, std::less<>>& manifest_setters();
constexpr const char* mandatory_columns[] = {"sku", "garment", "front"};

/// Sets one field; null setters are passed over. Errors: MANIFEST_VALUE, SKU_UNSAFE.
std::optional<Error> set_field(Setter setter, const ManifestField& field, const std::filesystem::path& folder,
                               CatalogItem& item);
/// The back comes from a photo or from the mirrored front: an item must say which, and not both. `where_of` names the
/// place of a column.
std::optional<Error> check_back(const CatalogItem& item, const std::function<std::string(const char*)>& where_of);

/// Sizes separated by blanks; empty optional where one is too long, repeated or has a control character.
std::optional<std::vector<std::string>> size_run(const std::string& text);

/// A manifest given as JSON.
Result<std::vector<CatalogItem>> read_json_manifest(const std::string& path, std::string_view text,
                                                    std::vector<std::string>& warnings);
Result<std::vector<CatalogItem>> read_csv_manifest(const std::string& path, std::string_view text,
                                                   std::vector<std::string>& warnings);

}  // namespace vitrine::input
