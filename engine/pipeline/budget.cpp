// SPDX-License-Identifier: GPL-3.0-or-later
// What may be asked of accuracy and time, and what became of it. Seconds are only another name for work here: no clock
// is read, so that the same request makes the same bytes on every machine.
#include "budget.hpp"

#include <cmath>
#include <cstdio>

namespace vitrine {
namespace {

// Node steps, by the time that `vitrine convert` spends in these rooms beside the sewing's own work and time
// (docs/ARCHITECTURE.md tells how they were measured).
constexpr double work_of_an_item = 9.0e6;        // the first picture, occlusion, files
constexpr double work_of_a_photo_pixel = 4.0;    // photo, silhouette, features, texture
constexpr double work_of_a_picture_pixel = 5.0;  // --views, --turntable

std::string millimetres(double mm) {
  char text[40];
  std::snprintf(text, sizeof text, "%.2g mm", mm);
  return text;
}

std::string seconds(double s) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g s", s);
  return text;
}

}  // namespace

double work_of_rooms(const ConvertRequest& request, const Conversion& item) {
  double photo_pixels = 0;
  for (const Image* photo : {&item.front.photo.rgb, &item.back.photo.rgb})
    photo_pixels += static_cast<double>(photo->width) * photo->height;
  const double view = static_cast<double>(request.pictures.width) * request.pictures.height;
  const double pictures =
      view * static_cast<double>(request.pictures.views.size()) + view / 4 * request.pictures.turntable;
  return work_of_an_item + work_of_a_photo_pixel * photo_pixels + work_of_a_picture_pixel * pictures;
}

BudgetFigures judge_budget(const ConvertRequest& request, const Drape& drape, double rooms,
                           std::vector<std::string>& warnings) {
  const Budget& asked = request.budget;
  BudgetFigures out;
  out.work = rooms + drape.work;
  out.allowed_work = asked.max_time * asked.work_rate;
  out.spent_s = out.work / asked.work_rate;
  out.error_met =
      asked.max_error <= 0 || (drape.error_estimate_mm && *drape.error_estimate_mm <= 1e3 * asked.max_error);
  out.time_met = asked.max_time <= 0 || out.work <= out.allowed_work;
  out.ended_by = drape.out_of_work ? "time" : asked.max_error > 0 && out.error_met ? "error" : "quality";
  if (!out.error_met)
    warnings.push_back(
        "MAX_ERROR_NOT_MET: " + millimetres(1e3 * asked.max_error) + " were asked, and the estimate is " +
        (drape.error_estimate_mm ? millimetres(*drape.error_estimate_mm) : "not known") +
        (drape.out_of_work ? " where --max-time ended it" : " on the finest mesh that --quality allows"));
  if (!out.time_met)
    warnings.push_back("MAX_TIME_NOT_MET: " + seconds(asked.max_time) +
                       " were asked, and the least that makes a garment that is close to rest takes " +
                       seconds(out.spent_s));
  return out;
}

nlohmann::ordered_json budget_as_json(const ConvertRequest& request, const Conversion& item) {
  using Json = nlohmann::ordered_json;
  const Budget& asked = request.budget;
  const BudgetFigures& b = item.budget;
  const auto& estimate = item.drape.error_estimate_mm;
  return {{"asked_error_mm", asked.max_error > 0 ? Json(1e3 * asked.max_error) : Json(nullptr)},
          {"estimated_error_mm", estimate ? Json(*estimate) : Json(nullptr)},
          {"asked_time_s", asked.max_time > 0 ? Json(asked.max_time) : Json(nullptr)},
          {"spent_s", b.spent_s},
          {"met", b.error_met && b.time_met},
          {"error_met", asked.max_error > 0 ? Json(b.error_met) : Json(nullptr)},
          {"time_met", asked.max_time > 0 ? Json(b.time_met) : Json(nullptr)},
          {"ended_by", b.ended_by},
          {"work_units", b.work},
          {"allowed_work_units", asked.max_time > 0 ? Json(b.allowed_work) : Json(nullptr)},
          {"work_units_per_second", asked.work_rate},
          {"levels", item.drape.levels.size()}};
}

std::string budget_json(const ConvertRequest& request, const Conversion& item) {
  return request.budget.asked() && !item.drape.status.empty() ? budget_as_json(request, item).dump() : std::string();
}

}  // namespace vitrine
