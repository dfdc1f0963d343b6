// SPDX-License-Identifier: GPL-3.0-or-later
#include "quarantine.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "atomic_file.hpp"
#include "report.hpp"

namespace vitrine {

std::optional<Error> add_reason(const CatalogItem& item, const ItemOutcome& outcome, const std::string& folder) {
  namespace fs = std::filesystem;
  const ItemStatus status = status_of(outcome);
  if (status != ItemStatus::refused && status != ItemStatus::partly) return {};
  const fs::path place = status == ItemStatus::partly ? fs::path(folder) / "quarantine" : fs::path(folder);
  std::error_code failed;
  fs::create_directories(place, failed);
  nlohmann::ordered_json reason{{"sku", item.sku}, {"garment", item.garment}};
  if (!item.title.empty()) reason["title"] = item.title;
  const auto report = nlohmann::json::parse(outcome.report_json_line, nullptr, false);
  for (const char* key : {"stage", "code", "message", "remedy", "sizes"})
    if (report.is_object() && report.contains(key)) reason[key] = report[key];
  const std::pair<const char*, const std::string&> photos[] = {
      {"front", item.front}, {"back", item.back}, {"front_mask", item.front_mask}, {"back_mask", item.back_mask}};
  for (const auto& [name, file] : photos) {
    if (file.empty()) continue;
    reason["photos"][name] = file;
    const fs::path link = place / ("photo-" + std::string(name) + fs::path(file).extension().string());
    fs::create_symlink(fs::absolute(file, failed), link, failed);  // a file system without links still has the paths
  }
  return write_atomically(place / "reason.json",
                          reason.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace vitrine
