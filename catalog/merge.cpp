// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "atomic_file.hpp"
#include "output.hpp"
#include "report_files.hpp"
#include "vitrine/run_catalog.hpp"

namespace vitrine {
namespace {

namespace fs = std::filesystem;

/// One shard's report as it lies in a folder.
struct ShardReport {
  int index = 0, of = 0;
  std::string catalogue;
  std::size_t items = 0;  ///< of the whole catalogue
  fs::path folder;        ///< shards/3-of-8
  fs::path root;          ///< the output folder it is in
  fs::file_time_type written;
};

std::vector<ShardReport> find_shards(const std::vector<std::string>& folders) {
  std::vector<ShardReport> found;
  for (const std::string& root : folders) {
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(fs::path(root) / "shards", failed)) {
      // Written last: without it the shard is not finished.
      const fs::path file = entry.path() / "summary.json";
      const auto json = nlohmann::json::parse(read_whole(file), nullptr, false);
      ShardReport shard;
      try {
        shard.index = json.at("shard").at("index").get<int>();
        shard.of = json.at("shard").at("of").get<int>();
        shard.catalogue = json.at("catalogue").at("id").get<std::string>();
        shard.items = json.at("catalogue").at("items").get<std::size_t>();
      } catch (const nlohmann::json::exception&) {
        continue;
      }
      if (shard.of < 2 || shard.of > 10'000 || shard.index < 0 || shard.index >= shard.of) continue;
      shard.folder = entry.path();
      shard.root = root;
      shard.written = fs::last_write_time(file, failed);
      found.push_back(shard);
    }
  }
  return found;
}

/// The newest report says which catalogue is meant; a shard that did not run since then has left an older one, which
/// still holds where nothing that decides it has changed.
std::map<int, ShardReport> of_newest_catalogue(const std::vector<ShardReport>& all) {
  const ShardReport& newest = *std::max_element(
      all.begin(), all.end(), [](const ShardReport& a, const ShardReport& b) { return a.written < b.written; });
  std::map<int, ShardReport> chosen;
  for (const ShardReport& shard : all) {
    if (shard.of != newest.of || shard.catalogue != newest.catalogue) continue;
    const auto [place, fresh] = chosen.emplace(shard.index, shard);
    if (!fresh && place->second.written < shard.written) place->second = shard;
  }
  return chosen;
}

std::map<std::string, std::string> lines_by_sku(const fs::path& file) {
  std::map<std::string, std::string> lines;
  const std::string text = read_whole(file);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    const auto json = nlohmann::json::parse(line, nullptr, false);
    if (json.is_object() && json.contains("sku") && json["sku"].is_string())
      lines[json["sku"].get<std::string>()] = line;
    begin = end + 1;
  }
  return lines;
}

/// Brings a folder of another output folder here, in one step: links where both are on one file system. Where there is
/// none, there is to be none here either.
std::string bring(const fs::path& from, const fs::path& place, const fs::path& work) {
  std::error_code failed;
  fs::remove_all(work, failed);
  if (fs::exists(from, failed)) {
    const auto kept = fs::copy_options::recursive | fs::copy_options::copy_symlinks;
    fs::copy(from, work, kept | fs::copy_options::create_hard_links, failed);
    if (failed) {
      fs::remove_all(work, failed);
      fs::copy(from, work, kept, failed);
    }
    if (failed) return failed.message();
  }
  const fs::path old = work.string() + "~old";
  fs::remove_all(old, failed);
  std::error_code none;
  if (fs::exists(fs::symlink_status(place, none))) fs::rename(place, old, failed);
  if (!failed && fs::exists(work, none)) fs::rename(work, place, failed);
  std::error_code ignored;
  fs::remove_all(old, ignored);
  return failed ? failed.message() : "";
}

}  // namespace

Result<MergedSummary> merge_catalog(const std::vector<std::string>& folders, const std::string& out_dir,
                                    double fail_share) {
  const std::vector<ShardReport> all = find_shards(folders);
  if (all.empty())
    return Error{Cause::missing, "NO_SHARDS",
                 (folders.empty() ? out_dir : folders.front()) + ": no shard has a report here",
                 "Run the shards first: vitrine catalog run --shard i/n.", "catalog"};
  const std::map<int, ShardReport> shards = of_newest_catalogue(all);
  OutputFolder folder;
  if (auto error = folder.open(out_dir, {}, 0, 1)) return *error;

  ReportLines lines;
  MergedSummary summary;
  ReportScope scope;
  scope.shards = summary.shards = shards.begin()->second.of;
  scope.catalogue = shards.begin()->second.catalogue;
  scope.items = shards.begin()->second.items;
  for (const auto& [index, shard] : shards) {
    const auto timings = lines_by_sku(shard.folder / "timings.jsonl");
    for (const auto& [sku, line] : lines_by_sku(shard.folder / "report.jsonl")) {
      const auto parsed = parse_line(line);
      if (!parsed)
        return Error{Cause::setup, "SHARD_REPORT",
                     (shard.folder / "report.jsonl").string() + ": item " + sku + " is no line of a report",
                     "Run shard " + std::to_string(index) + " again.", "catalog"};
      const auto timing = timings.find(sku);
      if (!lines.emplace(sku, ReportLine{line, timing == timings.end() ? "" : timing->second}).second)
        return Error{Cause::setup, "SKU_DUPLICATE",
                     (shard.folder / "report.jsonl").string() + ": item " + sku + " is in another shard too",
                     "Run all shards of one manifest with one version of the program.", "catalog"};
      count(summary, parsed->status);
      std::error_code failed;
      if (fs::equivalent(shard.root, folder.root(), failed)) continue;
      for (const fs::path& place : {fs::path(sku), fs::path("quarantine") / sku})
        if (const std::string why = bring(shard.root / place, folder.root() / place, folder.work() / sku); !why.empty())
          return Error{Cause::unwritable, "OUT_DIR", (folder.root() / place).string() + ": " + why,
                       "Free some space, or choose a folder that you may write to.", "catalog"};
    }
  }
  for (int i = 0; i < summary.shards; ++i)
    if (!shards.count(i)) scope.missing.push_back(i);
  summary.missing = scope.missing;
  summary.without_report = static_cast<int>(scope.items - std::min(scope.items, lines.size()));
  if (auto error = write_reports(folder.root(), folder.root(), lines, scope)) return *error;
  summary.report = (folder.root() / "report.jsonl").string();
  summary.exit_code = summary.missing.empty() ? exit_code_of(summary, fail_share) : 75;
  return summary;
}

}  // namespace vitrine
