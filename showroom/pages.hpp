// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "items.hpp"

namespace vitrine::showroom {

/// A page with places to fill, {{name}}. Values are put in once: what a value holds is never read as a place.
class Page {
 public:
  explicit Page(std::string source) : source_(std::move(source)) {}
  Page& text(const std::string& name, const std::string& value);  ///< escaped
  Page& html(const std::string& name, std::string value);         ///< as it is
  /// Error (65, SHOWROOM_ASSETS): the source has a place that no value was given for.
  Result<std::string> done() const;

 private:
  std::string source_;
  std::map<std::string, std::string> values_;
};

/// JSON as it may stand in a script element or an attribute: ASCII, without <, >, & and apostrophes.
std::string json_for_page(const nlohmann::json& json);

/// A word for people from an id of a plugin: "long_sleeve" is "Long sleeve", "neck_u" is "U neck".
std::string spoken(const std::string& id);

/// A file of an item's folder, below item/SKU/.
std::string place_in_item(const Look& look, const std::string& file);

/// "Sailor vest, cream (vest)": what a picture of the item shows, for those who do not see it.
std::string alt_of(const ShownItem& item);

/// A card of the grid; `eager`: in the first row, loaded at once.
std::string card_html(const ShownItem& item, bool eager);

/// An item as the grid's script reads it.
nlohmann::json card_json(const ShownItem& item);

/// The rest of an item's page: rows of the table of facts, its photos, the script's data.
std::string facts_html(const ShownItem& item);
std::string photos_html(const ShownItem& item, bool front, bool back);
nlohmann::json item_json(const ShownItem& item, const std::vector<WornBody>& bodies);

/// Choices of a filter with their counts, "<option value=..>Vest (3)</option>".
std::string options_html(const std::map<std::string, int>& counts);

nlohmann::json bodies_json(const std::vector<WornBody>& bodies);
nlohmann::json outfits_json(const ShownCatalogue& all);

}  // namespace vitrine::showroom
