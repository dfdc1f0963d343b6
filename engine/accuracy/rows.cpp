// SPDX-License-Identifier: GPL-3.0-or-later
#include "rows.hpp"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <type_traits>

namespace vitrine {
namespace {

using Json = nlohmann::json;

/// The columns of the three tables, each once: visit(name, member).
template <class Row, class Visit>
void each_of_run(Row& r, Visit&& visit) {
  visit("item", r.item);
  visit("source", r.source);
  visit("garment", r.garment);
  visit("setting", r.setting);
  visit("knob", r.knob);
  visit("value", r.value);
  visit("nodes", r.nodes);
  visit("residual", r.residual);
  visit("status", r.status);
  visit("cpu_ms", r.cpu_ms);
  visit("sewing_ms", r.sewing_ms);
  visit("peak_mb", r.peak_mb);
  visit("mean_mm", r.mean_mm);
  visit("p95_mm", r.p95_mm);
  visit("max_mm", r.max_mm);
  visit("hem_mm", r.hem_mm);
  visit("waist_mm", r.waist_mm);
  visit("chest_mm", r.chest_mm);
  visit("iou", r.iou);
  visit("landmark_mm", r.landmark_mm);
  visit("seam_gap_mm", r.seam_gap_mm);
  visit("penetration_mm", r.penetration_mm);
  visit("estimate_mm", r.estimate_mm);
  visit("spread_mm", r.spread_mm);
}

template <class Row, class Visit>
void each_of_effect(Row& r, Visit&& visit) {
  visit("item", r.item);
  visit("effect", r.effect);
  visit("reason", r.reason);
  visit("change_mean_mm", r.change_mean_mm);
  visit("change_max_mm", r.change_max_mm);
  visit("extra_ms", r.extra_ms);
}

template <class Row, class Visit>
void each_of_reference(Row& r, Visit&& visit) {
  visit("item", r.item);
  visit("nodes", r.nodes);
  visit("residual_a", r.residual_a);
  visit("residual_b", r.residual_b);
  visit("status_a", r.status_a);
  visit("status_b", r.status_b);
  visit("cpu_ms", r.cpu_ms);
  visit("spread_mean_mm", r.spread_mean_mm);
  visit("spread_p95_mm", r.spread_p95_mm);
  visit("spread_max_mm", r.spread_max_mm);
  visit("spread_hem_mm", r.spread_hem_mm);
  visit("spread_waist_mm", r.spread_waist_mm);
  visit("spread_chest_mm", r.spread_chest_mm);
}

template <class Row, class Visit>
void each_of_budget(Row& r, Visit&& visit) {
  visit("item", r.item);
  visit("status", r.status);
  visit("asked_mm", r.asked_mm);
  visit("estimated_mm", r.estimated_mm);
  visit("true_mm", r.true_mm);
  visit("cpu_ms", r.cpu_ms);
  visit("fine_cpu_ms", r.fine_cpu_ms);
  visit("sewing_ms", r.sewing_ms);
  visit("fine_sewing_ms", r.fine_sewing_ms);
  visit("met", r.met);
}

std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}
std::string field(int v) {
  return std::to_string(v);
}
std::string field(double v) {
  if (!std::isfinite(v)) return {};
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", v);
  return text;
}
std::string field(const std::optional<double>& v) {
  return v ? field(*v) : std::string();
}

template <class Row, class Each>
std::string csv(const std::vector<Row>& rows, Each&& each) {
  std::string out;
  const Row names;
  each(names, [&](const char* name, const auto&) { out += (out.empty() ? "" : ",") + std::string(name); });
  out += "\n";
  for (const Row& row : rows) {
    std::string line;
    bool first = true;
    each(row, [&](const char*, const auto& value) {
      line += (first ? "" : ",") + field(value);
      first = false;
    });
    out += line + "\n";
  }
  return out;
}

template <class Row, class Each>
Json pack(const std::vector<Row>& rows, Each&& each) {
  Json list = Json::array();
  for (const Row& row : rows) {
    Json json;
    each(row, [&](const char* name, const auto& value) {
      if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::optional<double>>)
        json[name] = value ? Json(*value) : Json();
      else
        json[name] = value;
    });
    list.push_back(std::move(json));
  }
  return list;
}

template <class Row, class Each>
void unpack(const Json& list, std::vector<Row>& rows, Each&& each) {
  for (const Json& json : list) {
    Row row;
    each(row, [&](const char* name, auto& value) {
      const Json& from = json.at(name);
      using Value = std::decay_t<decltype(value)>;
      if constexpr (std::is_same_v<Value, std::optional<double>>) {
        if (from.is_number()) value = from.template get<double>();
      } else if constexpr (std::is_same_v<Value, double>) {
        value = from.is_number() ? from.template get<double>() : NAN;  // JSON has no other word for what is not finite
      } else {
        value = from.template get<Value>();
      }
    });
    rows.push_back(std::move(row));
  }
}

constexpr auto runs_each = [](auto& row, auto&& visit) { each_of_run(row, visit); };
constexpr auto effects_each = [](auto& row, auto&& visit) { each_of_effect(row, visit); };
constexpr auto budgets_each = [](auto& row, auto&& visit) { each_of_budget(row, visit); };
constexpr auto references_each = [](auto& row, auto&& visit) { each_of_reference(row, visit); };

}  // namespace

std::string runs_csv(const std::vector<RunRow>& runs) {
  return csv(runs, runs_each);
}

std::string effects_csv(const std::vector<EffectRow>& effects) {
  return csv(effects, effects_each);
}

std::string references_csv(const std::vector<ReferenceRow>& references) {
  return csv(references, references_each);
}

std::string budgets_csv(const std::vector<BudgetRow>& budgets) {
  return csv(budgets, budgets_each);
}

namespace accuracy {

Bytes to_bytes(const Measurement& part) {
  const Json json{{"runs", pack(part.runs, runs_each)},
                  {"effects", pack(part.effects, effects_each)},
                  {"references", pack(part.references, references_each)},
                  {"budgets", pack(part.budgets, budgets_each)}};
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return {text.begin(), text.end()};
}

std::optional<Measurement> measurement_from(const Bytes& bytes) {
  Measurement part;
  try {
    const Json json = Json::parse(bytes.begin(), bytes.end());
    unpack(json.at("runs"), part.runs, runs_each);
    unpack(json.at("effects"), part.effects, effects_each);
    unpack(json.at("references"), part.references, references_each);
    unpack(json.at("budgets"), part.budgets, budgets_each);
  } catch (const Json::exception&) {
    return std::nullopt;
  }
  return part;
}

void append(Measurement& all, const Measurement& part) {
  all.runs.insert(all.runs.end(), part.runs.begin(), part.runs.end());
  all.effects.insert(all.effects.end(), part.effects.begin(), part.effects.end());
  all.references.insert(all.references.end(), part.references.begin(), part.references.end());
  all.budgets.insert(all.budgets.end(), part.budgets.begin(), part.budgets.end());
}

}  // namespace accuracy
}  // namespace vitrine
