// SPDX-License-Identifier: GPL-3.0-or-later
#include "manifest_fields.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "vitrine/sku.hpp"

namespace vitrine::input {
namespace {

namespace fs = std::filesystem;

template <std::string CatalogItem::*member>
std::optional<Error> set_text(const ManifestField& f, const fs::path&, CatalogItem& item) {
  item.*member = f.value;
  return {};
}

template <std::string CatalogItem::*member>
std::optional<Error> set_path(const ManifestField& f, const fs::path& folder, CatalogItem& item) {
  if (f.value.empty()) return {};
  if (has_control(f.value))
    return bad("MANIFEST_VALUE", f.where, "the file name has a control character in it",
               "Write the plain name of the photo.");
  item.*member = (folder / f.value).lexically_normal().string();
  return {};
}

template <std::optional<double> CatalogItem::*member>
std::optional<Error> set_cm(const ManifestField& f, const fs::path&, CatalogItem& item) {
  if (f.value.empty()) return {};
  double number = 0;
  const char* end = f.value.data() + f.value.size();
  const auto [rest, failed] = std::from_chars(f.value.data(), end, number);
  if (failed != std::errc() || rest != end || !std::isfinite(number) || number < 5 || number > 300)
    return bad("MANIFEST_VALUE", f.where, "\"" + shortened(f.value, 40) + "\" is not a length between 5 and 300",
               "Write centimetres with a decimal point, such as 46.5, or leave it empty.");
  item.*member = number;
  return {};
}

std::optional<Error> set_mirror(const ManifestField& f, const fs::path&, CatalogItem& item) {
  const std::string v = lower(f.value);
  if (v.empty()) return {};
  if (v != "yes" && v != "no" && v != "true" && v != "false" && v != "1" && v != "0")
    return bad("MANIFEST_VALUE", f.where, "\"" + shortened(f.value, 40) + "\" is neither yes nor no",
               "Write yes (make the back from the front's silhouette) or no, or leave it empty for no.");
  item.mirror_back = v == "yes" || v == "true" || v == "1";
  return {};
}

std::optional<Error> set_neckline(const ManifestField& f, const fs::path&, CatalogItem& item) {
  if (!f.value.empty()) item.neckline = f.value;
  return {};
}

std::optional<Error> set_mannequins(const ManifestField& f, const fs::path&, CatalogItem& item) {
  auto sizes = size_run(f.value);
  if (!sizes)
    return bad("MANIFEST_VALUE", f.where, "a size is repeated, too long, or the list has more than 32",
               "Write sizes or presets separated by blanks, such as XS S M L, each once.");
  item.mannequins = std::move(*sizes);
  return {};
}

std::optional<Error> set_sku(const ManifestField& f, const fs::path&, CatalogItem& item) {
  if (!is_safe_sku(f.value))
    return bad("SKU_UNSAFE", f.where, "\"" + shortened(f.value, 110) + "\" cannot be the name of a folder",
               "Use at most 100 of the characters A-Z a-z 0-9 . _ - and do not begin with . or -");
  item.sku = f.value;
  return {};
}

}  // namespace

const std::map<std::string, Setter, std::less<>>& manifest_setters() {
  static const std::map<std::string, Setter, std::less<>> all{{"sku", set_sku},
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
                                                              {"mannequin", set_mannequins},
                                                              {"title", set_text<&CatalogItem::title>},
                                                              {"copyright", set_text<&CatalogItem::copyright>},
                                                              {"product_id", set_text<&CatalogItem::product_id>}};
  return all;
}

std::optional<std::vector<std::string>> size_run(const std::string& text) {
  std::vector<std::string> sizes = split(text, ' ');
  if (sizes.size() > 32) return {};
  for (std::size_t i = 0; i < sizes.size(); ++i)
    if (sizes[i].size() > 200 || has_control(sizes[i]) ||
        std::find(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(i), sizes[i]) !=
            sizes.begin() + static_cast<std::ptrdiff_t>(i))
      return {};
  return sizes;
}

std::optional<Error> set_field(Setter setter, const ManifestField& field, const fs::path& folder, CatalogItem& item) {
  if (setter == nullptr) return {};
  if (field.value.size() > max_field)
    return bad("MANIFEST_VALUE", field.where, "the field is longer than 4096 bytes", "Shorten it.");
  if (field.value.empty() &&
      std::find(std::begin(mandatory_columns), std::end(mandatory_columns), field.name) != std::end(mandatory_columns))
    return bad("MANIFEST_VALUE", field.where, "the field is empty", "Fill it in, or delete the row.");
  return setter(field, folder, item);
}

std::optional<Error> check_back(const CatalogItem& item, const std::function<std::string(const char*)>& where_of) {
  if (item.back.empty() && !item.mirror_back)
    return bad("MANIFEST_VALUE", where_of("back"), "there is neither a back photo nor mirror_back",
               "Name the back photo, or write yes in mirror_back to make the back from the front's silhouette.");
  if (!item.back.empty() && item.mirror_back)
    return bad("MANIFEST_VALUE", where_of("mirror_back"),
               "the row has a back photo, and mirror_back says to do without",
               "Leave mirror_back empty to use the photo, or leave back empty.");
  if (!item.back_mask.empty() && item.mirror_back)
    return bad("MANIFEST_VALUE", where_of("back_mask"), "a mask of the back without a back photo",
               "Leave back_mask empty, or name the back photo and leave mirror_back empty.");
  return {};
}

}  // namespace vitrine::input
