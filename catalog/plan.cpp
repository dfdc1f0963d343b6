// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "output.hpp"
#include "vitrine/sku.hpp"

namespace vitrine {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// All of a row that the function sees. Its place in the manifest is not part of it.
std::string row_text(const CatalogItem& item) {
  const Json row{{"sku", item.sku},
                 {"garment", item.garment},
                 {"neckline", item.neckline},
                 {"front", item.front},
                 {"back", item.back},
                 {"mirror_back", item.mirror_back},
                 {"front_mask", item.front_mask},
                 {"back_mask", item.back_mask},
                 {"chest_cm", item.chest_cm ? Json(*item.chest_cm) : Json(nullptr)},
                 {"length_cm", item.length_cm ? Json(*item.length_cm) : Json(nullptr)},
                 {"fabric", item.fabric},
                 {"title", item.title},
                 {"copyright", item.copyright},
                 {"mannequins", item.mannequins},
                 {"refusal", item.refusal ? item.refusal->code + ": " + item.refusal->message : ""}};
  return row.dump(-1, ' ', false, Json::error_handler_t::replace);
}

struct InputFile {
  const char* name;
  const std::string& file;
};
std::vector<InputFile> inputs_of(const CatalogItem& item) {
  std::vector<InputFile> files;
  for (const InputFile& input : {InputFile{"front", item.front}, InputFile{"back", item.back},
                                 InputFile{"front_mask", item.front_mask}, InputFile{"back_mask", item.back_mask}})
    if (!input.file.empty()) files.push_back(input);
  return files;
}

std::string readable(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name == "front" || name == "back" ? name + " photo" : name;
}

}  // namespace

Planner::Planner(const CatalogOptions& options, const fs::path& root, const Journal& journal)
    : options_(options),
      root_(root),
      journal_(journal),
      engine_(sha256_of(options.identity.engine)),
      plugins_(sha256_of(options.identity.plugins)) {}

Decision Planner::decide(const CatalogItem& item) const {
  Decision decision;
  JournalEntry& entry = decision.entry;
  const JournalEntry* known = journal_.find(item.sku);
  entry.parts = {{"row", sha256_of(row_text(item))},
                 {"settings", sha256_of(options_.identity.settings ? options_.identity.settings(item) : "")},
                 {"engine", engine_},
                 {"plugins", plugins_}};
  for (const InputFile& input : inputs_of(item)) {
    const Fingerprint* print = nullptr;
    if (known != nullptr)
      if (const auto found = known->inputs.find(input.name); found != known->inputs.end()) print = &found->second;
    entry.inputs[input.name] = fingerprint(input.file, print, options_.checksum);
  }
  std::string all;
  for (const auto& [name, hash] : entry.parts) all += name + " " + hash + "\n";
  for (const auto& [name, print] : entry.inputs) all += name + " " + print.sha256 + "\n";
  entry.key = sha256_of(all);
  decision.why = reason_to_run(item, decision);
  decision.runs = !decision.why.empty();
  if (decision.runs) return decision;
  decision.why = known->record.status == ItemStatus::ok ? "unchanged"
                                                        : std::string("unchanged, ") + name_of(known->record.status) +
                                                              " before (" + known->record.code + ")";
  decision.refreshed = entry.inputs != known->inputs || entry.outputs != known->outputs;
  entry.record = known->record;
  entry.attempts = known->attempts;
  return decision;
}

std::string Planner::reason_to_run(const CatalogItem& item, Decision& decision) const {
  const JournalEntry* known = journal_.find(item.sku);
  JournalEntry& entry = decision.entry;
  if (known == nullptr) return "new";
  if (known->key != entry.key) {
    std::string changed;
    const auto note = [&](const std::string& what) { changed += (changed.empty() ? "" : ", ") + what; };
    for (const auto& [name, print] : entry.inputs) {
      const auto before = known->inputs.find(name);
      if (before != known->inputs.end() && before->second.sha256 == print.sha256) continue;
      note(readable(name) + (print.sha256 == "missing" ? " is missing" : " changed"));
    }
    for (const auto& [name, hash] : entry.parts)
      if (const auto before = known->parts.find(name); before == known->parts.end() || before->second != hash)
        note(name + " changed");
    return changed.empty() ? "its photos changed while it was made" : changed;
  }
  if (options_.force) return "forced";
  entry.attempts = known->attempts + 1;
  switch (known->record.status) {
    case ItemStatus::refused:
      if (options_.retry_refused) return "refused before (" + known->record.code + ")";
      break;
    case ItemStatus::partly:
      if (options_.retry_refused) return "partly refused before (" + known->record.code + ")";
      break;
    case ItemStatus::failed:
    case ItemStatus::crashed:
    case ItemStatus::timeout:
      // A full disk or a folder without permission is nothing that the item can help.
      if (known->record.exit_code == 73 || known->attempts < 2 || options_.retry_failed)
        return std::string(name_of(known->record.status)) + " before (" + known->record.code + ")";
      break;
    default:
      break;
  }
  return changed_output(decision, *known);
}

std::string Planner::changed_output(Decision& decision, const JournalEntry& known) const {
  for (const auto& [path, print] : known.outputs) {
    const fs::path file = root_ / path;
    const std::optional<FileStamp> stamp = stamp_of(file);
    if (!stamp) return path + " is missing";
    if (!options_.checksum && print.stamp == stamp) {
      decision.entry.outputs[path] = print;
      continue;
    }
    const Fingerprint now = own_fingerprint(file);
    if (now.sha256 != print.sha256) return path + " was changed";
    decision.entry.outputs[path] = now;
  }
  return "";
}

bool Planner::same_inputs(const CatalogItem& item, const Fingerprints& prints) {
  for (const InputFile& input : inputs_of(item)) {
    const Fingerprint& before = prints.at(input.name);
    if (before.stamp && stamp_of(input.file) == before.stamp) continue;
    if (fingerprint(input.file, nullptr, true).sha256 != before.sha256) return false;
  }
  return true;
}

std::string catalogue_id(const std::vector<CatalogItem>& items, const RunIdentity& identity) {
  std::vector<std::string> rows;
  for (const CatalogItem& item : items)
    rows.push_back(sha256_of(row_text(item)) + (identity.settings ? sha256_of(identity.settings(item)) : ""));
  std::sort(rows.begin(), rows.end());
  std::string all = identity.engine + "\n" + identity.plugins + "\n";
  for (const std::string& row : rows) all += row + "\n";
  return sha256_of(all);
}

int shard_of(const std::string& sku, int shards) {
  return static_cast<int>(std::stoull(sha256_of(sku).substr(0, 15), nullptr, 16) % static_cast<unsigned>(shards));
}

std::vector<const CatalogItem*> items_of_shard(const std::vector<CatalogItem>& items, const CatalogOptions& options) {
  std::vector<const CatalogItem*> own;
  for (const CatalogItem& item : items)
    if (options.shards == 1 || shard_of(item.sku, options.shards) == options.shard) own.push_back(&item);
  return own;
}

std::optional<Error> check_arguments(const std::vector<CatalogItem>& items, const CatalogOptions& options) {
  if (options.jobs < 1 || options.jobs > 256 || !(options.item_seconds > 0) || options.item_seconds > 1e6 ||
      options.item_cpu_seconds < 0)
    return Error{Cause::usage, "JOBS", "jobs has to be 1 to 256, and the time limits of an item above 0",
                 "Give the number of processor cores as jobs.", "catalog"};
  if (options.shards < 1 || options.shards > 10'000 || options.shard < 0 || options.shard >= options.shards)
    return Error{Cause::usage, "SHARD",
                 "shard " + std::to_string(options.shard) + " of " + std::to_string(options.shards) + " does not exist",
                 "Of n shards, 1 to 10,000, the first is 0 and the last n - 1.", "catalog"};
  std::set<std::string> names;
  for (const CatalogItem& item : items)
    if (!is_safe_sku(item.sku) || !names.insert(item.sku).second)
      return Error{Cause::usage, "SKU_UNSAFE", "\"" + item.sku + "\" is used twice or cannot be the name of a folder",
                   "Read the items with read_manifest, which checks this.", "catalog"};
  return {};
}

Result<std::vector<PlannedItem>> plan_catalog(const std::vector<CatalogItem>& items, const CatalogOptions& options) {
  if (auto error = check_arguments(items, options)) return *error;
  const fs::path root(options.out_dir), state = root / OutputFolder::state_folder;
  Journal journal;
  if (auto error = journal.open(state / ("journal" + OutputFolder::suffix_of(options.shard, options.shards) + ".jsonl"),
                                state, false))
    return *error;
  const Planner planner(options, root, journal);
  std::vector<PlannedItem> plan;
  for (const CatalogItem* item : items_of_shard(items, options)) {
    Decision decision = planner.decide(*item);
    plan.push_back({item->sku, decision.runs, std::move(decision.why)});
  }
  return plan;
}

}  // namespace vitrine
