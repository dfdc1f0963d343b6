// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>

#include "vitrine/run_catalog.hpp"
#include "worker.hpp"

namespace vitrine {

enum class ItemStatus { ok, partly, refused, failed, crashed, timeout, not_run };

const char* name_of(ItemStatus status);
std::optional<ItemStatus> status_named(const std::string& name);

/// One item's line of report.jsonl, and what is kept apart from it because it differs from run to run.
struct ItemRecord {
  ItemStatus status = ItemStatus::not_run;
  int exit_code = 75;
  std::string code;    ///< reason code
  std::string line;    ///< JSON, without the line break
  std::string timing;  ///< line of timings.jsonl
  bool has_models() const { return status == ItemStatus::ok || status == ItemStatus::partly; }
  bool has_quarantine() const { return status == ItemStatus::refused || status == ItemStatus::partly; }
};

/// What an exit code of an item's function means.
ItemStatus status_of(const ItemOutcome& outcome);

ItemRecord record_of(const CatalogItem& item, const WorkerEnd& end, bool timed_out, const CatalogOptions& options);
ItemRecord not_run(const CatalogItem& item);
/// The item ended well but its folder could not be put in place.
ItemRecord unwritable(const CatalogItem& item, const std::string& why);

void count(StatusCounts& counts, ItemStatus status);
/// 1 when more than this share of the items is not ok.
int exit_code_of(const StatusCounts& counts, double fail_share);

/// "ok" -> out/<sku>, refused ones -> out/quarantine/<sku>: path in the output folder of a file in the item's folder.
std::string place_of(const std::string& sku, ItemStatus status, const std::string& file);

}  // namespace vitrine
