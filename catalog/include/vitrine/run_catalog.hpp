// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "vitrine/catalog.hpp"

namespace vitrine {

/// What became of one item, as its function reports it.
struct ItemOutcome {
  int exit_code = 0;             ///< 0 = converted; else the error's exit code (65 = refused with a reason, ...)
  std::string report_json_line;  ///< a JSON object; "code" and "message" tell why, other keys are kept as they are
  /// With exit code 65: some sizes of a size run were made and lie in the item's folder, what is known of the others in
  /// its subfolder "quarantine".
  bool partly = false;
  std::string stage_ms_json = {};  ///< a JSON object of processor milliseconds by room, or empty; goes to timings.jsonl
};

/// Converts one item into `item_dir`, an empty folder. Runs in a forked worker: it may crash or hang without harm to
/// the others, sees what the parent had loaded, and nothing it changes in memory comes back.
using ItemFunction = std::function<ItemOutcome(const CatalogItem& item, const std::string& item_dir)>;

/// What a finished item depends on besides its row and its photos. Texts; another text makes the item anew.
struct RunIdentity {
  std::string engine;   ///< version of the program
  std::string plugins;  ///< ids, versions and hashes
  /// All settings that decide the item's bytes, its mannequins' content included. May be empty.
  std::function<std::string(const CatalogItem&)> settings;
};

enum class ProgressKind {
  none,
  automatic,  ///< a bar on a terminal, lines elsewhere
  json        ///< an object a second, a line each
};

struct CatalogOptions {
  std::string out_dir;            ///< made if it does not exist
  int jobs = 1;                   ///< workers at a time, 1 to 256
  double item_seconds = 600;      ///< [s] an item's worker is killed after this time
  int item_cpu_seconds = 0;       ///< [s] of processor time of a worker; 0 = no limit
  std::uint64_t item_memory = 0;  ///< [byte] address space of a worker above what is loaded; 0 = no limit
  int shard = 0, shards = 1;      ///< only items whose SKU's hash is `shard` modulo `shards`, 1 to 10,000
  RunIdentity identity;
  bool force = false;          ///< make every item anew
  bool retry_refused = false;  ///< also items that were refused and whose inputs are the same
  bool retry_failed = false;   ///< also items that crashed, hung or failed twice with the same inputs
  bool checksum = false;       ///< read every photo and output again instead of trusting size and times
  bool why = false;            ///< say on standard error for each item why it is made, or that it is not
  double fail_share = 0;       ///< exit code 1 when a larger share of the items than this is not ok; 1 = never
  ProgressKind progress = ProgressKind::automatic;  ///< to standard error
  /// Called in this process before an item's worker is forked: loads what several items share. An error ends the run.
  /// May be empty.
  std::function<std::optional<Error>(const CatalogItem&)> prepare;
};

/// How many of a report's items have which status.
struct StatusCounts {
  int total = 0;
  int ok = 0;
  int partly = 0;     ///< some sizes of a size run were refused
  int refused = 0;    ///< the photo, settings or files cannot be used
  int failed = 0;     ///< our fault (70), the disk's (73), or a worker that ended without a report
  int crashed = 0;    ///< ended by a signal
  int timed_out = 0;  ///< took longer than it may
  int not_run = 0;    ///< stopped by SIGINT or SIGTERM before they ended
};

struct CatalogSummary : StatusCounts {
  int unchanged = 0;  ///< of these, were not touched because nothing of theirs had changed
  bool interrupted = false;
  std::string report;  ///< path of report.jsonl
  /// 75 when interrupted; 1 when more than `fail_share` of the items are not ok; else 0.
  int exit_code = 0;
};

/// Runs `convert` on each item that is new or changed, at most `jobs` at a time, each in a worker forked from this
/// process: call it before any thread is started. docs/CATALOG.md tells what appears in `out_dir`, what is kept from
/// run to run, and how. All files appear in one step, none is ever seen half-written. The reports and items have the
/// same bytes for any number of jobs, any order of the items, and any number of interruptions before.
/// Errors: unwritable (73: OUT_DIR, OUT_DIR_FOREIGN when a folder of an item's name is not from an earlier run,
/// REPORT), temporary (75: OUT_DIR_BUSY while another run uses it, FORK), usage (64: JOBS, SHARD, SKU_UNSAFE).
Result<CatalogSummary> run_catalog(const std::vector<CatalogItem>& items, const CatalogOptions& options,
                                   const ItemFunction& convert);

/// What run_catalog() would do with an item, and why.
struct PlannedItem {
  std::string sku;
  bool runs = false;
  std::string why;  ///< e.g. "new", "its front photo changed", "unchanged"
};
/// The same decisions as run_catalog() takes, in the items' order; only the shard's items; nothing is written.
/// Errors: usage (64: JOBS, SHARD, SKU_UNSAFE).
Result<std::vector<PlannedItem>> plan_catalog(const std::vector<CatalogItem>& items, const CatalogOptions& options);

struct MergedSummary : StatusCounts {
  int shards = 0;
  std::vector<int> missing;  ///< shards without a report
  int without_report = 0;    ///< items of the manifest that the missing shards should have reported
  std::string report;        ///< path of report.jsonl
  int exit_code = 0;         ///< 75 when shards are missing, else as CatalogSummary
};

/// Makes one report of the shards that ran into `folders`; when other folders than `out_dir` are among them, their
/// items are linked or copied into `out_dir`. Shards of an earlier run with other items, settings or number of shards
/// are left out; a shard that was not finished is missing. Errors: missing (66: NO_SHARDS), setup (78: SHARD_REPORT
/// damaged, SKU_DUPLICATE), unwritable (73), temporary (75: OUT_DIR_BUSY).
Result<MergedSummary> merge_catalog(const std::vector<std::string>& folders, const std::string& out_dir,
                                    double fail_share);

/// The shard of a SKU: the same on every machine and for ever.
int shard_of(const std::string& sku, int shards);

}  // namespace vitrine
