// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>

#include "vitrine/run_catalog.hpp"

namespace vitrine {

/// Adds to a refused item's folder what a person needs to see why: reason.json, and links to its photos and masks. Of
/// an item that was partly made, into its subfolder quarantine. Does nothing for other outcomes. Error: REPORT (73).
std::optional<Error> add_reason(const CatalogItem& item, const ItemOutcome& outcome, const std::string& folder);

}  // namespace vitrine
