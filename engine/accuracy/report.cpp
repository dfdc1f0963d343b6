// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "charts.hpp"
#include "rows.hpp"

namespace vitrine {
namespace {

using namespace accuracy;
using Json = nlohmann::ordered_json;

std::string fixed(double v, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", digits, v);
  return text;
}

std::string if_any(int count, double v, int digits) {
  return count > 0 ? fixed(v, digits) : "–";
}

/// Mean and worst of what there is.
struct Mean {
  double sum = 0, most = 0;
  int count = 0;
  void add(const std::optional<double>& v) {
    if (!v) return;
    sum += *v;
    most = std::max(most, *v);
    ++count;
  }
  double mean() const { return count > 0 ? sum / count : 0; }
};

Mean spread_of(const Measurement& m) {
  Mean spread;
  for (const ReferenceRow& r : m.references) spread.add(r.spread_mean_mm);
  return spread;
}

const RunRow* run_of(const Measurement& m, const std::string& item, const std::string& setting) {
  for (const RunRow& r : m.runs)
    if (r.item == item && r.setting == setting) return &r;
  return nullptr;
}

/// How the three qualities stand to each other and to the bars, item by item.
struct Verdict {
  int compared = 0, falling = 0, draft_met = 0, standard_met = 0, fine_met = 0;
};
constexpr double draft_bar = 10, standard_bar = 4;  // [mm] mean

Verdict judge(const Measurement& m) {
  Verdict v;
  for (const ReferenceRow& reference : m.references) {
    const RunRow *draft = run_of(m, reference.item, "draft"), *standard = run_of(m, reference.item, "standard"),
                 *fine = run_of(m, reference.item, "fine");
    if (!draft || !standard || !fine || !draft->mean_mm || !standard->mean_mm || !fine->mean_mm) continue;
    ++v.compared;
    v.falling += *draft->mean_mm > *standard->mean_mm && *standard->mean_mm > *fine->mean_mm;
    v.draft_met += *draft->mean_mm <= draft_bar;
    v.standard_met += *standard->mean_mm <= standard_bar;
    v.fine_met += reference.spread_mean_mm && *fine->mean_mm <= *reference.spread_mean_mm;
  }
  return v;
}

std::string settings_table(const std::vector<SettingMeans>& means, bool knobs) {
  std::string out =
      "| setting | items | nodes | CPU [ms] | sewing [ms] | memory [MB] | mean [mm] | p95 [mm] | max [mm] | worst "
      "item's "
      "mean [mm] | hem [mm] | waist [mm] | chest [mm] | IoU "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const SettingMeans& m : means) {
    if (knobs == m.knob.empty() && m.setting != "standard") continue;
    out += "| " + m.setting + " | " + std::to_string(m.with_reference) + " | " + fixed(m.nodes, 0) + " | " +
           fixed(m.cpu_ms, 0) + " | " + fixed(m.sewing_ms, 0) + " | " + fixed(m.peak_mb, 0) + " | " +
           if_any(m.with_reference, m.mean_mm, 2) + " | " + if_any(m.with_reference, m.p95_mm, 1) + " | " +
           if_any(m.with_reference, m.max_mm, 1) + " | " + if_any(m.with_reference, m.worst_mean_mm, 2) + " | " +
           if_any(m.with_hem, m.hem_mm, 1) + " | " + if_any(m.with_waist, m.waist_mm, 1) + " | " +
           if_any(m.with_chest, m.chest_mm, 1) + " | " + if_any(m.with_iou, m.iou, 3) + " |\n";
  }
  return out;
}

struct EffectMeans {
  Mean change, worst, extra;
  int skipped = 0, inside = 0;
};
constexpr double effect_bar = 0.5;  // [mm] mean

std::map<std::string, EffectMeans> effects_of(const Measurement& m) {
  std::map<std::string, EffectMeans> out;
  for (const EffectRow& row : m.effects) {
    EffectMeans& e = out[row.effect];
    ++e.skipped;
    e.change.add(row.change_mean_mm);
    e.worst.add(row.change_max_mm);
    if (row.extra_ms) e.extra.sum += *row.extra_ms, ++e.extra.count;  // may be negative
    e.inside += row.change_mean_mm && *row.change_mean_mm <= effect_bar;
  }
  return out;
}

std::string markdown(const Measurement& m, const std::vector<SettingMeans>& means, const MeasureOptions& options) {
  const Verdict v = judge(m);
  const Mean spread = spread_of(m);
  const std::string of = " of " + std::to_string(v.compared) + " items";
  double reference_s = 0;
  for (const ReferenceRow& r : m.references) reference_s += r.cpu_ms / 1000;
  const double each = m.references.empty() ? 0 : reference_s / (2.0 * static_cast<double>(m.references.size()));
  std::string out =
      "# What a millimetre costs\n\nMade by `vitrine measure` (" + options.version +
      "). Times are processor time; distances are between surfaces, both ways, from " +
      "20,000 samples on each.\n\n## Reference\n\n" + std::to_string(options.reference_nodes) + " nodes, residual " +
      [&] {
        char text[24];
        std::snprintf(text, sizeof text, "%.0e", options.reference_residual);
        return std::string(text);
      }() +
      " or " + std::to_string(options.reference_iterations) +
      " steps a level, from two starts. Mean distance of the two: " + fixed(spread.mean(), 2) + " mm (worst item " +
      fixed(spread.most, 2) + " mm): no rest shape is truer than that. One reference took " + fixed(each, 0) +
      " s of a processor.\n\n| item | nodes | residual A | residual B | status A | status B | spread mean "
      "[mm] | p95 | max | hem | waist | chest |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  const auto cell = [](const std::optional<double>& x, int digits) { return x ? fixed(*x, digits) : "–"; };
  const auto power = [](double x) {
    char text[24];
    std::snprintf(text, sizeof text, "%.1e", x);
    return std::string(text);
  };
  for (const ReferenceRow& r : m.references)
    out += "| " + r.item + " | " + std::to_string(r.nodes) + " | " + power(r.residual_a) + " | " + power(r.residual_b) +
           " | " + r.status_a + " | " + r.status_b + " | " + cell(r.spread_mean_mm, 2) + " | " +
           cell(r.spread_p95_mm, 1) + " | " + cell(r.spread_max_mm, 1) + " | " + cell(r.spread_hem_mm, 1) + " | " +
           cell(r.spread_waist_mm, 1) + " | " + cell(r.spread_chest_mm, 1) + " |\n";

  out +=
      "\n## Qualities\n\n" + settings_table(means, false) +
      "\nFalls from draft to standard to fine: " + std::to_string(v.falling) + of +
      ". Draft at most 10 mm: " + std::to_string(v.draft_met) + of +
      ". Standard at most 4 mm: " + std::to_string(v.standard_met) + of +
      ". Fine within the item's spread: " + std::to_string(v.fine_met) + of + ".\n\n" +
      "| item | source | garment | draft [mm] | standard [mm] | fine [mm] | spread [mm] | draft [ms] | standard [ms] "
      "| fine [ms] | IoU, standard | status |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  std::string last;
  for (const RunRow& r : m.runs) {
    if (r.item == last) continue;
    last = r.item;
    out += "| " + r.item + " | " + r.source + " | " + r.garment + " |";
    for (const char* name : {"draft", "standard", "fine"}) {
      const RunRow* run = run_of(m, r.item, name);
      out += " " + (run ? cell(run->mean_mm, 2) : "–") + " |";
    }
    out += " " + cell(r.spread_mm, 2) + " |";
    for (const char* name : {"draft", "standard", "fine"}) {
      const RunRow* run = run_of(m, r.item, name);
      out += " " + (run ? fixed(run->cpu_ms, 0) : "–") + " |";
    }
    const RunRow* standard = run_of(m, r.item, "standard");
    out += " " + (standard ? cell(standard->iou, 3) : "–") + " | " + (standard ? standard->status : r.status) + " |\n";
  }

  if (!m.budgets.empty()) {
    int met = 0, known = 0;
    double cpu = 0, fine = 0;
    out +=
        "\n## An error asked for\n\n| item | asked [mm] | estimated [mm] | true [mm] | met | CPU [ms] | fine's [ms] "
        "|\n|---|---|---|---|---|---|---|\n";
    for (const BudgetRow& b : m.budgets) {
      out += "| " + b.item + " | " + fixed(b.asked_mm, 1) + " | " + cell(b.estimated_mm, 2) + " | " +
             cell(b.true_mm, 2) + " | " + b.met + " | " + fixed(b.cpu_ms, 0) + " | " + fixed(b.fine_cpu_ms, 0) + " |\n";
      met += b.met == "yes";
      known += b.met != "unknown";
      cpu += b.cpu_ms;
      fine += b.fine_cpu_ms;
    }
    out += "\nMet on " + std::to_string(met) + " of " + std::to_string(known) + " items, at " +
           (fine > 0 ? fixed(100 * cpu / fine, 0) : "–") + " % of fine's processor time.\n";
  }

  bool any_knob = false;
  for (const SettingMeans& s : means) any_knob |= !s.knob.empty();
  if (any_knob) out += "\n## One knob at a time\n\n" + settings_table(means, true);
  if (!m.effects.empty()) {
    out +=
        "\n## What standard left out\n\nEach effect that the drape reports as skipped, turned on: how far the cloth "
        "moved, and the time that was saved.\n\n| effect | skipped for | measured on | change mean [mm] | worst item's "
        "mean [mm] | largest [mm] | at most 0.5 mm | saved [ms] |\n|---|---|---|---|---|---|---|---|\n";
    for (const auto& [effect, e] : effects_of(m))
      out += "| " + effect + " | " + std::to_string(e.skipped) + " | " + std::to_string(e.change.count) + " | " +
             if_any(e.change.count, e.change.mean(), 3) + " | " + if_any(e.change.count, e.change.most, 3) + " | " +
             if_any(e.worst.count, e.worst.most, 1) + " | " +
             (e.change.count > 0 ? std::to_string(e.inside) + " of " + std::to_string(e.change.count) : "–") + " | " +
             if_any(e.extra.count, e.extra.mean(), 0) + " |\n";
    out +=
        "\nEffects that were measured on no item cannot be turned on: the engine has no other way of making the cloth, "
        "or leaves out nothing but empty space.\n";
  }
  return out;
}

Json summary(const Measurement& m, const std::vector<SettingMeans>& means, const MeasureOptions& options) {
  const Verdict v = judge(m);
  Json json{{"version", options.version},
            {"reference",
             {{"nodes", options.reference_nodes},
              {"residual", options.reference_residual},
              {"iterations", options.reference_iterations},
              {"items", m.references.size()},
              {"spread_mean_mm", spread_of(m).mean()},
              {"spread_worst_mm", spread_of(m).most}}},
            {"bars",
             {{"items", v.compared},
              {"falling", v.falling},
              {"draft_at_most_10_mm", v.draft_met},
              {"standard_at_most_4_mm", v.standard_met},
              {"fine_within_spread", v.fine_met}}}};
  Json list = Json::array();
  for (const SettingMeans& s : means)
    list.push_back({{"setting", s.setting},
                    {"items", s.items},
                    {"refused", s.refused},
                    {"compared", s.with_reference},
                    {"nodes", s.nodes},
                    {"cpu_ms", s.cpu_ms},
                    {"sewing_ms", s.sewing_ms},
                    {"peak_mb", s.peak_mb},
                    {"mean_mm", s.mean_mm},
                    {"p95_mm", s.p95_mm},
                    {"max_mm", s.max_mm},
                    {"worst_mean_mm", s.worst_mean_mm},
                    {"hem_mm", s.hem_mm},
                    {"waist_mm", s.waist_mm},
                    {"chest_mm", s.chest_mm},
                    {"iou", s.iou},
                    {"landmark_mm", s.landmark_mm}});
  json["settings"] = std::move(list);
  Json effects = Json::object();
  for (const auto& [effect, e] : effects_of(m))
    effects[effect] = {{"skipped", e.skipped},
                       {"measured", e.change.count},
                       {"at_most_half_a_mm", e.inside},
                       {"change_mean_mm", e.change.mean()},
                       {"change_worst_mean_mm", e.change.most},
                       {"saved_ms", e.extra.mean()}};
  json["effects"] = std::move(effects);
  return json;
}

}  // namespace

std::optional<Error> write_measurement(const Measurement& measurement, const MeasureOptions& options) {
  const std::string base = options.out_dir + "/";
  const auto means = means_by_setting(measurement.runs);
  const double spread = spread_of(measurement).mean();
  const Drawing pareto = pareto_chart(measurement.runs, means, spread);
  const auto png = encode_png(pareto.pixels(2));
  if (!png) return png.error();
  if (auto e = write_file(base + "pareto.png", *png)) return e;
  const std::pair<const char*, std::string> files[] = {
      {"runs.csv", runs_csv(measurement.runs)},
      {"effects.csv", effects_csv(measurement.effects)},
      {"references.csv", references_csv(measurement.references)},
      {"pareto.svg", pareto.svg()},
      {"knobs.svg", knobs_chart(means, spread).svg()},
      {"measure.md", markdown(measurement, means, options)},
      {"summary.json",
       summary(measurement, means, options).dump(2, ' ', false, Json::error_handler_t::replace) + "\n"}};
  if (!measurement.budgets.empty())
    if (auto e = write_file(base + "budget.csv", budgets_csv(measurement.budgets))) return e;
  for (const auto& [name, content] : files)
    if (auto e = write_file(base + name, content)) return e;
  return std::nullopt;
}

}  // namespace vitrine
