// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.hpp"

#include <string.h>

#include <cstdio>
#include <nlohmann/json.hpp>

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
                const std::string& message, const Json& more = Json::object()) {
  Json line;
  line["sku"] = item.sku;
  line["garment"] = item.garment;
  line["status"] = name_of(status);
  line["exit_code"] = exit_code;
  line["code"] = code;
  line["message"] = message;
  for (const auto& [key, value] : more.items())
    if (!line.contains(key)) line[key] = value;
  // A message may quote bytes of a foreign file.
  return {status, exit_code, code, line.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

std::string text_of(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

const char* name_of(ItemStatus status) {
  switch (status) {
    case ItemStatus::ok:
      return "ok";
    case ItemStatus::refused:
      return "refused";
    case ItemStatus::failed:
      return "failed";
    case ItemStatus::crashed:
      return "crashed";
    case ItemStatus::timeout:
      return "timeout";
    case ItemStatus::not_run:
      break;
  }
  return "not_run";
}

ItemRecord record_of(const CatalogItem& item, const WorkerEnd& end, bool timed_out, double limit_seconds) {
  if (timed_out) {
    char limit[32];
    std::snprintf(limit, sizeof limit, "%g", limit_seconds);
    return make(item, ItemStatus::timeout, 70, "TIMED_OUT",
                std::string("the conversion took longer than ") + limit + " s");
  }
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
  const int code = end.outcome->exit_code;
  const ItemStatus status = code == 0 ? ItemStatus::ok : code == 70 ? ItemStatus::failed : ItemStatus::refused;
  return make(item, status, code, text_of(json, "code"), text_of(json, "message"), json);
}

ItemRecord not_run(const CatalogItem& item) {
  return make(item, ItemStatus::not_run, 75, "INTERRUPTED", "the run was stopped before this item ended");
}

ItemRecord unwritable(const CatalogItem& item, const std::string& why) {
  return make(item, ItemStatus::refused, 73, "OUT_DIR", "the result cannot be put into its folder: " + why);
}

}  // namespace vitrine
