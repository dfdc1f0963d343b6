// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.hpp"

#include <signal.h>
#include <string.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "report_files.hpp"

namespace vitrine {
namespace {

using Json = nlohmann::ordered_json;

/// Nesting of a text that claims to be JSON. The parser keeps its own stack, but writing recurses.
bool too_deep(const std::string& text) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\')
        ++i;
      else if (c == '"')
        quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '{' || c == '[') {
      if (++depth > 32) return true;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return false;
}

ItemRecord make(const CatalogItem& item, ItemStatus status, int exit_code, const std::string& code,
                const std::string& message, const Json& more = Json::object(), const Json& outputs = Json::object()) {
  Json line;
  line["sku"] = item.sku;
  line["garment"] = item.garment;
  if (!item.title.empty()) line["title"] = item.title;
  line["status"] = name_of(status);
  line["exit_code"] = exit_code;
  line["code"] = code;
  line["message"] = message;
  for (const auto& [key, value] : more.items())
    if (!line.contains(key) && key != "outputs" && key != "title") line[key] = value;
  if (!outputs.empty()) line["outputs"] = outputs;
  // A message may quote bytes of a foreign file.
  return {status, exit_code, code, line.dump(-1, ' ', false, Json::error_handler_t::replace), ""};
}

constexpr std::pair<ItemStatus, const char*> names[] = {
    {ItemStatus::ok, "ok"},           {ItemStatus::partly, "partly"},   {ItemStatus::refused, "refused"},
    {ItemStatus::failed, "failed"},   {ItemStatus::crashed, "crashed"}, {ItemStatus::timeout, "timeout"},
    {ItemStatus::not_run, "not_run"},
};

std::string timing_of(const CatalogItem& item, const WorkerEnd& end) {
  Json line;
  line["sku"] = item.sku;
  line["cpu_ms"] = std::round(end.cpu_seconds * 1e3);
  line["wall_ms"] = std::round(end.wall_seconds * 1e3);
  line["peak_mb"] = std::round(static_cast<double>(end.peak_kilobytes) / 102.4) / 10;
  if (end.outcome && !end.outcome->stage_ms_json.empty() && !too_deep(end.outcome->stage_ms_json)) {
    const Json stages = Json::parse(end.outcome->stage_ms_json, nullptr, false);
    if (stages.is_object()) line["stage_ms"] = stages;
  }
  return line.dump(-1, ' ', false, Json::error_handler_t::replace);
}

ItemRecord judge(const CatalogItem& item, const WorkerEnd& end, bool timed_out, const CatalogOptions& options) {
  const auto late = [&](double limit, const char* unit) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", limit);
    return make(item, ItemStatus::timeout, 70, "TIMED_OUT",
                std::string("the conversion took longer than ") + text + unit);
  };
  if (timed_out) return late(options.item_seconds, " s");
  if (end.signal == SIGXCPU) return late(options.item_cpu_seconds, " s of processor time");
  if (end.signal != 0) {
    const char* name = ::sigabbrev_np(end.signal);
    return make(item, ItemStatus::crashed, 70, "CRASHED",
                "the conversion was ended by signal " + std::to_string(end.signal) +
                    (name != nullptr ? std::string(" (SIG") + name + ")" : ""));
  }
  const auto no_report = [&](const char* why) { return make(item, ItemStatus::failed, 70, "NO_REPORT", why); };
  if (!end.outcome) return no_report("the conversion ended without a report");
  if (end.outcome->report_json_line.empty()) return no_report("the conversion gave an empty report");
  if (too_deep(end.outcome->report_json_line)) return no_report("the conversion's report is nested too deeply");
  const Json json = Json::parse(end.outcome->report_json_line, nullptr, false);
  if (!json.is_object()) return no_report("the conversion's report is not a JSON object");
  const ItemStatus status = status_of(*end.outcome);
  Json outputs = Json::object();
  if (status != ItemStatus::failed)
    for (const auto& [file, print] : end.files) outputs[place_of(item.sku, status, file)] = print.sha256;
  return make(item, status, end.outcome->exit_code, text_of(json, "code"), text_of(json, "message"), json, outputs);
}

}  // namespace

const char* name_of(ItemStatus status) {
  for (const auto& [value, name] : names)
    if (value == status) return name;
  return "not_run";
}

std::optional<ItemStatus> status_named(const std::string& text) {
  for (const auto& [value, name] : names)
    if (text == name) return value;
  return {};
}

ItemStatus status_of(const ItemOutcome& outcome) {
  switch (outcome.exit_code) {
    case 0:
      return ItemStatus::ok;
    case 70:  // our fault
    case 73:  // the disk's, not the item's
      return ItemStatus::failed;
    default:
      return outcome.partly ? ItemStatus::partly : ItemStatus::refused;
  }
}

ItemRecord record_of(const CatalogItem& item, const WorkerEnd& end, bool timed_out, const CatalogOptions& options) {
  ItemRecord record = judge(item, end, timed_out, options);
  record.timing = timing_of(item, end);
  return record;
}

ItemRecord not_run(const CatalogItem& item) {
  return make(item, ItemStatus::not_run, 75, "INTERRUPTED", "the run was stopped before this item ended");
}

ItemRecord unwritable(const CatalogItem& item, const std::string& why) {
  return make(item, ItemStatus::failed, 73, "OUT_DIR", "the result cannot be put into its folder: " + why);
}

void count(StatusCounts& counts, ItemStatus status) {
  ++counts.total;
  int StatusCounts::*const of[] = {&StatusCounts::ok,     &StatusCounts::partly,  &StatusCounts::refused,
                                   &StatusCounts::failed, &StatusCounts::crashed, &StatusCounts::timed_out,
                                   &StatusCounts::not_run};
  ++(counts.*of[static_cast<std::size_t>(status)]);
}

int exit_code_of(const StatusCounts& counts, double fail_share) {
  return counts.total - counts.ok > fail_share * counts.total ? 1 : 0;
}

std::string place_of(const std::string& sku, ItemStatus status, const std::string& file) {
  if (status == ItemStatus::refused) return "quarantine/" + sku + "/" + file;
  constexpr std::string_view apart = "quarantine/";
  if (file.rfind(apart, 0) == 0) return "quarantine/" + sku + "/" + file.substr(apart.size());
  return sku + "/" + file;
}

}  // namespace vitrine
