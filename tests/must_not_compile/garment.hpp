// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A sound skirt whose tables each snippet changes in one place.
#include "vitrine/check.hpp"
#include "vitrine/templates/skirt.hpp"

using namespace vitrine;

/// A copy of a table after one change.
template <class Table>
consteval Table changed(Table table, auto change) {
  change(table);
  return table;
}
