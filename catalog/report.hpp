// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "vitrine/catalog.hpp"
#include "worker.hpp"

namespace vitrine {

enum class ItemStatus { ok, refused, failed, crashed, timeout, not_run };

/// One item's line of report.jsonl.
struct ItemRecord {
  ItemStatus status = ItemStatus::not_run;
  int exit_code = 75;
  std::string code;  ///< reason code
  std::string line;  ///< JSON, without the line break
  /// Its folder may be published.
  bool has_result() const {
    return (exit_code == 0 && status == ItemStatus::ok) || (exit_code == 65 && status == ItemStatus::refused);
  }
};

const char* name_of(ItemStatus status);
ItemRecord record_of(const CatalogItem& item, const WorkerEnd& end, bool timed_out, double limit_seconds);
ItemRecord not_run(const CatalogItem& item);
/// The item ended well but its folder could not be put in place.
ItemRecord unwritable(const CatalogItem& item, const std::string& why);

}  // namespace vitrine
