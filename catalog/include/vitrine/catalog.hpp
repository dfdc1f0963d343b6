// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vitrine/model/result.hpp"

namespace vitrine {

/// One row of a manifest.
struct CatalogItem {
  std::string sku;      ///< unique; also the name of the item's folder: [A-Za-z0-9._-], not beginning with . or -
  std::string garment;  ///< garment type, e.g. "vest"
  std::string neckline = "auto";  ///< neckline id, or "auto"
  std::string front, back;        ///< photo files; back is empty with mirror_back
  /// Make the back panel from the front's mirrored silhouette, because the shop has no back photo. Each row has either
  /// this or a back photo.
  bool mirror_back = false;
  std::string front_mask, back_mask;  ///< mask files, or empty
  std::optional<double> chest_cm;     ///< [cm] flat width the garment type names: armpit to armpit, a skirt's waist
  std::optional<double> length_cm;    ///< [cm]
  std::string fabric;                 ///< fabric of the garment type, or empty for its default
  std::string title;                  ///< for people
  std::string copyright;              ///< line kept in the item's files, or empty
  int line = 0;                       ///< of the manifest, for messages
  /// Size run: mannequins as --mannequin takes them, or the sizes XS, S, M, L, XL, XXL. Empty = the run's own.
  std::vector<std::string> mannequins;
  std::string product_id;  ///< the shop's own id where that cannot be a folder's name; else empty
  /// Set when a feed's product cannot be converted: it has its place in the reports, but there is nothing to run.
  std::shared_ptr<const Error> refusal;
};

/// Reads a manifest: CSV (RFC 4180: commas, quotes, line breaks in quotes; LF or CRLF; UTF-8 with or without BOM), the
/// first row names the columns. Paths are relative to the manifest's folder. At most 64 MB and 1,000,000 rows.
/// `warnings` receives one sentence per column that is not known; when null they are logged.
/// Errors: missing (66: MANIFEST_MISSING), unusable (65: MANIFEST_TOO_LARGE, MANIFEST_EMPTY, MANIFEST_ENCODING,
/// MANIFEST_CSV, MANIFEST_COLUMN, MANIFEST_VALUE, SKU_UNSAFE, SKU_DUPLICATE), each with file, line and column.
Result<std::vector<CatalogItem>> read_manifest(const std::string& path, std::vector<std::string>* warnings = nullptr);

/// What became of one item, as its function reports it.
struct ItemOutcome {
  int exit_code = 0;             ///< 0 = converted; else the error's exit code (65 = refused with a reason, ...)
  std::string report_json_line;  ///< a JSON object; "code" and "message" tell why, other keys are kept as they are
};

/// Converts one item into `item_dir`, an empty folder. Runs in a forked worker: it may crash or hang without harm to
/// the others, sees what the parent had loaded, and nothing it changes in memory comes back.
using ItemFunction = std::function<ItemOutcome(const CatalogItem& item, const std::string& item_dir)>;

struct CatalogOptions {
  std::string out_dir;            ///< made if it does not exist
  int jobs = 1;                   ///< workers at a time, 1 to 256
  double item_seconds = 600;      ///< [s] an item's worker is killed after this time
  std::uint64_t item_memory = 0;  ///< [byte] address space of a worker; 0 = no limit
  bool progress = true;           ///< to standard error: one updating line on a terminal, else a line per item
};

struct CatalogSummary {
  int total = 0;
  int ok = 0;         ///< exit code 0
  int refused = 0;    ///< the photo, settings or files cannot be used
  int failed = 0;     ///< our fault (70), or a worker that ended without a report
  int crashed = 0;    ///< ended by a signal
  int timed_out = 0;  ///< took longer than item_seconds
  int not_run = 0;    ///< stopped by SIGINT or SIGTERM before they ended
  bool interrupted = false;
  std::string report;  ///< path of report.jsonl
  /// 75 when interrupted; 70 when an item failed, crashed or timed out; else the exit code that all refused items
  /// share, or 65 when they differ; 0 when all are ok.
  int exit_code = 0;
};

/// Runs `convert` on each item, at most `jobs` at a time, each in a worker forked from this process: call it before any
/// thread is started. Results appear as `<out_dir>/<sku>/` in one step when an item ended with exit code 0 or 65 and a
/// report; an item that ended otherwise has no folder. `<out_dir>/report.jsonl` has one line per item in the manifest's
/// order, the same bytes for any number of jobs: {"sku","garment","status","exit_code","code","message", the caller's
/// keys}, status one of ok, refused, failed, crashed, timeout, not_run.
/// Errors: unwritable (73: OUT_DIR, OUT_DIR_FOREIGN when a folder of an item's name is not from an earlier run,
/// OUT_DIR_BUSY while another run uses it, REPORT), usage (64: JOBS, SKU_UNSAFE), internal (70: FORK).
Result<CatalogSummary> run_catalog(const std::vector<CatalogItem>& items, const CatalogOptions& options,
                                   const ItemFunction& convert);

}  // namespace vitrine
