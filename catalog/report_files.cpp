// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_files.hpp"

#include <cmath>

#include "atomic_file.hpp"

namespace vitrine {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const StatusCounts& c) {
  return {{"total", c.total},
          {"ok", c.ok},
          {"partly", c.partly},
          {"refused", c.refused},
          {"failed", c.failed},
          {"crashed", c.crashed},
          {"timeout", c.timed_out},
          {"not_run", c.not_run},
          {"ok_share", c.total > 0 ? std::round(1e4 * c.ok / c.total) / 1e4 : 1.0}};
}

std::string summary_json(const std::vector<ParsedLine>& lines, const ReportScope& scope) {
  StatusCounts all;
  std::map<std::string, StatusCounts> by_garment;
  std::map<std::string, int> by_code;
  for (const ParsedLine& line : lines) {
    count(all, line.status);
    count(by_garment[line.json.value("garment", "")], line.status);
    if (line.status != ItemStatus::ok) ++by_code[line.json.value("code", "")];
  }
  Json json = to_json(all);
  json["by_garment"] = Json::object();
  for (const auto& [garment, counts] : by_garment) json["by_garment"][garment] = to_json(counts);
  json["by_code"] = by_code;
  json["catalogue"] = {{"id", scope.catalogue}, {"items", scope.items}};
  if (scope.is_shard) json["shard"] = {{"index", scope.shard}, {"of", scope.shards}};
  if (!scope.missing.empty()) json["missing_shards"] = {{"of", scope.shards}, {"shards", scope.missing}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string text_of(const nlohmann::ordered_json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

std::optional<ParsedLine> parse_line(const std::string& line) {
  ParsedLine parsed;
  parsed.json = Json::parse(line, nullptr, false);
  const auto text = [&](const char* key) {
    return parsed.json.is_object() && parsed.json.contains(key) && parsed.json[key].is_string();
  };
  if (!text("sku") || !text("garment") || !text("status") || !text("code") || !text("message")) return {};
  const auto status = status_named(parsed.json["status"].get<std::string>());
  if (!status) return {};
  parsed.sku = parsed.json["sku"].get<std::string>();
  parsed.status = *status;
  return parsed;
}

std::optional<Error> write_reports(const std::filesystem::path& folder, const std::filesystem::path& root,
                                   const ReportLines& lines, const ReportScope& scope) {
  std::string report, timings;
  std::vector<ParsedLine> parsed;
  for (const auto& [sku, line] : lines) {
    report += line.line + "\n";
    if (!line.timing.empty()) timings += line.timing + "\n";
    if (auto p = parse_line(line.line)) parsed.push_back(*std::move(p));
  }
  if (auto error = write_atomically(folder / "report.jsonl", report)) return error;
  if (auto error = write_atomically(folder / "timings.jsonl", timings)) return error;
  if (!scope.is_shard) {
    if (auto error = write_atomically(folder / "junit.xml", junit_xml(parsed))) return error;
    if (auto error = write_atomically(folder / "report.html", report_html(parsed, scope, root))) return error;
  }
  // Last: a report is complete when it has one.
  return write_atomically(folder / "summary.json", summary_json(parsed, scope));
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t' || c == '\r')
          out += c;
        else
          out += "\xEF\xBF\xBD";
    }
  }
  return out;
}

std::string junit_xml(const std::vector<ParsedLine>& lines) {
  std::map<std::string, std::vector<const ParsedLine*>> suites;
  for (const ParsedLine& line : lines) suites[line.json.value("garment", "")].push_back(&line);
  // A refusal says something of the item, an error of the program; what was not run is neither.
  const auto kind_of = [](ItemStatus status) {
    return status == ItemStatus::ok                                        ? ""
           : status == ItemStatus::refused || status == ItemStatus::partly ? "failure"
           : status == ItemStatus::not_run                                 ? "skipped"
                                                                           : "error";
  };
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"vitrine catalog\">\n";
  for (const auto& [garment, items] : suites) {
    std::map<std::string, int> counts;
    for (const ParsedLine* item : items) ++counts[kind_of(item->status)];
    xml += "  <testsuite name=\"" + escaped(garment) + "\" tests=\"" + std::to_string(items.size()) + "\" failures=\"" +
           std::to_string(counts["failure"]) + "\" errors=\"" + std::to_string(counts["error"]) + "\" skipped=\"" +
           std::to_string(counts["skipped"]) + "\">\n";
    for (const ParsedLine* item : items) {
      const std::string kind = kind_of(item->status);
      xml += "    <testcase classname=\"catalog." + escaped(garment) + "\" name=\"" + escaped(item->sku) + "\"";
      if (kind.empty()) {
        xml += "/>\n";
        continue;
      }
      xml += "><" + kind + " message=\"" + escaped(item->json.value("message", "")) + "\"";
      if (kind != "skipped") xml += " type=\"" + escaped(item->json.value("code", "")) + "\"";
      xml += "/></testcase>\n";
    }
    xml += "  </testsuite>\n";
  }
  return xml + "</testsuites>\n";
}

}  // namespace vitrine
