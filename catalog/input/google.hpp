// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "product.hpp"

namespace vitrine::input {

/// One product of a Merchant Center feed, attribute by attribute, from either of its formats.
struct GoogleRow {
  Product product;
  std::string group;  ///< item_group_id: sizes and colours of one garment share it
};

/// Takes one attribute: its name without "g:" and with blanks for underscores. Returns false for one we do not use.
bool take_google_attribute(GoogleRow& row, std::string_view name, const std::string& value);

/// Rows of one group and colour are sizes of one garment: they become one product that has all their ids, named after
/// the group (and colour, where the group has several). It has the texts and pictures of the row whose id comes first
/// in the order of bytes, so the order of the rows does not matter.
std::vector<Product> merge_google_rows(std::vector<GoogleRow> rows, const std::string& file);

}  // namespace vitrine::input
