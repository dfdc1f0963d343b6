// SPDX-License-Identifier: GPL-3.0-or-later
// One item of a catalogue, on one mannequin or on several.
#include "catalog_item.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace vitrine::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string to_text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// What one conversion leaves in report.jsonl: enough to sort a night's work by, the rest is in the item's report.json.
Json report_of(const Conversion& item, const ConvertRequest* request = nullptr) {
  Json line = Json::object();
  if (item.error)
    line = {{"code", item.error->code},
            {"message", item.error->message},
            {"remedy", item.error->remedy},
            {"stage", item.error->stage}};
  if (!item.drape.status.empty())
    line.update({{"neckline", item.front.features.neckline.id},
                 {"residual", item.drape.residual},
                 {"seam_gap_mm_max", item.drape.seam_gap_mm_max},
                 {"penetration_mm_max", item.drape.penetration_mm_max},
                 {"strain_p99", item.drape.strain_p99}});
  if (const std::string budget = request ? budget_json(*request, item) : ""; !budget.empty())
    line["budget"] = Json::parse(budget);
  if (!item.warnings.empty()) line["warnings"] = item.warnings;
  return line;
}

ItemOutcome refuse(const Error& error) {
  Conversion item;
  item.error = error;
  return {error.exit_code(), to_text(report_of(item))};
}

/// What was seen in the photos of a refused item, for people: outline, points, the inside of the back.
std::optional<Error> write_overlays(const ConvertRequest& request, const Conversion& item, const std::string& folder) {
  bool first = true;
  for (const Side side : {Side::front, Side::back}) {
    const Image overlay = draw_view(view_of(request, side), side == Side::front ? item.front : item.back);
    // Where no outline was found there is still the photo.
    const Image& picture = overlay.empty() ? (side == Side::front ? item.front : item.back).photo.rgb : overlay;
    if (picture.empty()) continue;
    if (!overlay.empty()) {
      const auto jpeg = encode_jpeg(overlay, 85);
      if (!jpeg) return jpeg.error();
      if (auto e = write_file(folder + (side == Side::front ? "/overlay-front.jpg" : "/overlay-back.jpg"), *jpeg))
        return e;
    }
    if (!first) continue;
    first = false;
    const auto small = thumbnail_of(picture);
    if (!small) return small.error();
    if (auto e = write_file(folder + "/thumb.jpg", *small)) return e;
  }
  return std::nullopt;
}

/// Sizes of one garment as the report tells them, and the first thing that went wrong.
struct SizeRun {
  Json sizes = Json::array();
  std::optional<Error> error;
  int made = 0;
  std::map<std::string, double> ms;

  void add(const std::string& name, const Conversion& item, const ConvertRequest& request) {
    Json size{{"size", name}, {"exit_code", item.exit_code()}};
    size.update(report_of(item, &request));
    sizes.push_back(std::move(size));
    for (const auto& [stage, value] : item.stage_ms) ms[stage] += value;
    if (!item.error)
      ++made;
    else if (!error || error->exit_code() < item.error->exit_code())
      error = item.error;
  }

  ItemOutcome outcome() const {
    Json line = Json::object();
    if (error)
      line = {{"code", error->code}, {"message", error->message}, {"remedy", error->remedy}, {"stage", error->stage}};
    line["sizes"] = sizes;
    const int code = error ? error->exit_code() : 0;
    return {code, to_text(line), made > 0 && error, Json(ms).dump()};
  }
};

}  // namespace

ConvertRequest request_of(const CatalogItem& row) {
  ConvertRequest request;
  request.name = row.sku;
  request.front = row.front;
  request.back = row.back;
  request.front_mask = row.front_mask;
  request.back_mask = row.back_mask;
  request.mirror_back = row.mirror_back;
  request.fabric = row.fabric;
  request.chest = row.chest_cm.value_or(0) / 100;
  request.length = row.length_cm.value_or(0) / 100;
  return request;
}

std::string ItemKitchen::settings_of(const CatalogItem& row) const {
  std::string text = settings;
  for (const std::string& name : mannequins_of(row)) text += "mannequin " + shelf.identity(name) + "\n";
  return text;
}

std::optional<Error> ItemKitchen::prepare(const CatalogItem& row) const {
  if (row.refusal) return std::nullopt;  // nothing is made of it
  for (const std::string& name : mannequins_of(row)) {
    const auto body = shelf.make(name);
    if (!body && row.mannequins.empty()) return body.error();
  }
  return std::nullopt;
}

ItemOutcome ItemKitchen::convert_item(const CatalogItem& row, const std::string& folder) const {
  if (row.refusal) return refuse(*row.refusal);
  ConvertRequest request = request_of(row);
  request.thumbnail = true;
  request.times_in_report = false;
  if (auto e = job.apply(request)) return refuse(*e);
  if (!row.copyright.empty()) request.copyright = row.copyright;
  if (auto e = choose_garment(registry, row.garment, row.neckline, request)) return refuse(*e);
  const std::vector<std::string>& names = mannequins_of(row);
  if (names.size() > 1)
    if (auto e = MannequinShelf::check_run(names)) return refuse(*e);

  Conversion seen = see_photos(request);
  if (seen.error || names.size() == 1) {
    if (!seen.error) {
      const auto body = shelf.make(names.front());
      if (!body) return refuse(body.error());
      request.body = *body;
      seen = dress(std::move(seen), request);
    }
    if (auto e = write_conversion(request, seen, folder)) return refuse(*e);
    if (seen.error)
      if (auto e = write_overlays(request, seen, folder)) return refuse(*e);
    return {seen.exit_code(), to_text(report_of(seen, &request)), false, stage_ms_json(seen)};
  }

  SizeRun run;
  for (const std::string& name : names) {
    const std::string size = MannequinShelf::folder_of(name);
    Conversion item = seen;
    seen.stage_ms.clear();  // counted once
    if (const auto body = shelf.make(name); body) {
      request.body = *body;
      item = dress(std::move(item), request);
    } else {
      item.error = body.error();
    }
    const std::string place = folder + "/" + (item.error ? "quarantine/" : "") + size;
    if (auto e = write_conversion(request, item, place)) return refuse(*e);
    if (item.error)
      if (auto e = write_overlays(request, item, place)) return refuse(*e);
    run.add(size, item, request);
    if (!item.error && run.made == 1)
      if (auto e = write_file(folder + "/thumb.jpg", item.thumbnail)) return refuse(*e);
  }
  // All of them refused: there is nothing to keep apart.
  std::error_code failed;
  if (run.made == 0)
    for (const auto& size : std::filesystem::directory_iterator(folder + "/quarantine", failed))
      std::filesystem::rename(size.path(), std::filesystem::path(folder) / size.path().filename(), failed);
  if (run.made == 0) std::filesystem::remove(folder + "/quarantine", failed);
  return run.outcome();
}

}  // namespace vitrine::cli
