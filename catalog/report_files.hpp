// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "report.hpp"
#include "vitrine/escaped.hpp"

namespace vitrine {

/// A report's lines by SKU, which is their order in every file: it depends on no manifest and no number of shards.
struct ReportLine {
  std::string line, timing;
};
using ReportLines = std::map<std::string, ReportLine>;

/// Which part of a catalogue a report is about.
struct ReportScope {
  int shard = 0, shards = 1;
  std::string catalogue;     ///< catalogue_id()
  std::size_t items = 0;     ///< of the whole catalogue
  std::vector<int> missing;  ///< of a merged report: shards that are not in it
  bool is_shard = false;     ///< the report of one shard: no pages, they would show a part as the whole
};

/// What is kept of a line for counting and showing.
struct ParsedLine {
  std::string sku;
  ItemStatus status = ItemStatus::not_run;
  nlohmann::ordered_json json;
};
/// Empty when a line is none of a report's.
std::optional<ParsedLine> parse_line(const std::string& line);
/// What a report's line has under a key; empty where that is no text.
std::string text_of(const nlohmann::ordered_json& json, const char* key);

/// Writes report.jsonl, timings.jsonl, junit.xml, report.html and, last, summary.json into `folder`, each in one step;
/// thumbnails are taken from the items' folders in `root`. Error: REPORT (73).
std::optional<Error> write_reports(const std::filesystem::path& folder, const std::filesystem::path& root,
                                   const ReportLines& lines, const ReportScope& scope);

std::string junit_xml(const std::vector<ParsedLine>& lines);
std::string report_html(const std::vector<ParsedLine>& lines, const ReportScope& scope,
                        const std::filesystem::path& root);

}  // namespace vitrine
