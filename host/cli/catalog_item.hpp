// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "mannequin_shelf.hpp"
#include "vitrine/run_catalog.hpp"

namespace vitrine::cli {

/// What a row says of its item; the garment's template is still to be chosen.
ConvertRequest request_of(const CatalogItem& row);

/// What every item of a catalogue is made with.
struct ItemKitchen {
  const PluginRegistry& registry;
  const JobOptions& job;
  MannequinShelf& shelf;
  std::vector<std::string> mannequins;  ///< of rows that name none; one, or a size run
  std::string settings;                 ///< the command line's options that decide an item's bytes

  const std::vector<std::string>& mannequins_of(const CatalogItem& row) const {
    return row.mannequins.empty() ? mannequins : row.mannequins;
  }
  /// Text of all that decides the item's bytes besides its row, photos, plugins and the program.
  std::string settings_of(const CatalogItem& row) const;
  /// Makes the row's mannequins. Error only when the run's own cannot be made: then no item can.
  std::optional<Error> prepare(const CatalogItem& row) const;
  /// Converts one item into `folder`; runs in its worker.
  ItemOutcome convert_item(const CatalogItem& row, const std::string& folder) const;
};

}  // namespace vitrine::cli
