// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <string>

namespace vitrine {

/// Whether a sku can be the name of a folder everywhere, and of nothing but a folder in its parent.
inline bool is_safe_sku(const std::string& sku) {
  const auto allowed = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
           c == '-';
  };
  // What a run puts beside the items' folders.
  for (const char* taken :
       {"quarantine", "shards", "report.jsonl", "report.html", "timings.jsonl", "summary.json", "junit.xml"})
    if (sku == taken) return false;
  return !sku.empty() && sku.size() <= 100 && sku[0] != '.' && sku[0] != '-' &&
         std::all_of(sku.begin(), sku.end(), allowed);
}

}  // namespace vitrine
