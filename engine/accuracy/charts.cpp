// SPDX-License-Identifier: GPL-3.0-or-later
#include "charts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace vitrine::accuracy {
namespace {

const std::string ink = "#222222", faint = "#dddddd", pale = "#9fb8d0", setting_colour = "#2c6da4", named = "#b3541e",
                  front_colour = "#1b6e3c", grey = "#888888";

std::string text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

/// An axis by decades over pixels [from, to].
class Decades {
 public:
  Decades(const std::vector<double>& values, double from, double to) : from_(from), to_(to) {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (const double v : values)
      if (v > 0) low = std::min(low, v), high = std::max(high, v);
    if (!(high > 0)) low = high = 1;
    low_ = std::log10(low) - 0.1;
    high_ = std::max(std::log10(high) + 0.1, low_ + 0.5);
  }
  double operator()(double v) const {
    return from_ + (to_ - from_) * (std::log10(std::max(v, 1e-6)) - low_) / (high_ - low_);
  }
  /// 1, 2 and 5 of each decade.
  std::vector<double> ticks() const {
    std::vector<double> out;
    for (int d = static_cast<int>(std::floor(low_)); d <= std::ceil(high_); ++d)
      for (const double m : {1.0, 2.0, 5.0}) {
        const double v = m * std::pow(10.0, d), at = std::log10(v);
        if (at >= low_ && at <= high_) out.push_back(v);
      }
    return out;
  }

 private:
  double from_, to_, low_ = 0, high_ = 1;
};

}  // namespace

Drawing pareto_chart(const std::vector<RunRow>& runs, const std::vector<SettingMeans>& means, double spread_mm) {
  Drawing d(860, 560);
  const double left = 70, right = 830, top = 50, bottom = 500;
  std::vector<double> costs, errors{spread_mm};
  for (const RunRow& r : runs)
    if (r.mean_mm && *r.mean_mm > 0) costs.push_back(r.cpu_ms), errors.push_back(*r.mean_mm);
  const Decades x(costs, left, right), y(errors, bottom, top);
  for (const double v : x.ticks()) {
    d.line({{x(v), top}, {x(v), bottom}}, faint, 1);
    d.words({x(v), bottom + 18}, text("%g", v), ink, Anchor::middle);
  }
  for (const double v : y.ticks()) {
    d.line({{left, y(v)}, {right, y(v)}}, faint, 1);
    d.words({left - 8, y(v) + 4}, text("%g", v), ink, Anchor::end);
  }
  d.words({left, 24}, "mean distance to the reference [mm] against processor time of the whole item [ms]", ink,
          Anchor::start, 14);
  d.words({(left + right) / 2, bottom + 40}, "processor time [ms]", ink, Anchor::middle);
  if (spread_mm > 0) {
    d.line({{left, y(spread_mm)}, {right, y(spread_mm)}}, grey, 1.5);
    d.words({right - 6, y(spread_mm) - 5}, "spread of two references", grey, Anchor::end, 11);
  }
  for (const RunRow& r : runs)
    if (r.mean_mm && *r.mean_mm > 0) d.dot({x(r.cpu_ms), y(*r.mean_mm)}, 1.6, pale);
  std::vector<double> cost, error;
  std::vector<const SettingMeans*> who;
  for (const SettingMeans& m : means)
    if (m.with_reference > 0) cost.push_back(m.cpu_ms), error.push_back(m.mean_mm), who.push_back(&m);
  std::vector<Vec2> front;
  const auto best = pareto_front(cost, error);
  for (const std::size_t i : best) front.emplace_back(x(cost[i]), y(error[i]));
  d.line(front, front_colour, 1.5);
  std::vector<Vec2> named_at;  // where names begin; the qualities' stand beside their dots, the others keep off
  for (std::size_t i = 0; i < who.size(); ++i) {
    if (!who[i]->knob.empty()) continue;
    named_at.emplace_back(x(cost[i]) + 8, y(error[i]) - 7);
    d.words(named_at.back(), who[i]->setting, named, Anchor::start, 13);
  }
  for (std::size_t i = 0; i < who.size(); ++i) {
    const bool quality = who[i]->knob.empty();
    const Vec2 at(x(cost[i]), y(error[i]));
    d.dot(at, quality ? 5 : 3.2, quality ? named : setting_colour);
    if (!quality && std::find(best.begin(), best.end(), i) != best.end()) {
      // Names that would run into each other stand below each other.
      Vec2 place = at + Vec2(6, 15);
      const auto taken = [&](const Vec2& p) {
        return std::abs(p.x() - place.x()) < 150 && std::abs(p.y() - place.y()) < 12;
      };
      while (std::any_of(named_at.begin(), named_at.end(), taken)) place.y() += 12;
      named_at.push_back(place);
      d.line({at, place + Vec2(-2, -4)}, setting_colour, 0.5);
      d.words(place, who[i]->setting, setting_colour, Anchor::start, 10);
    }
  }
  return d;
}

Drawing knobs_chart(const std::vector<SettingMeans>& means, double spread_mm) {
  std::vector<std::string> knobs;
  const SettingMeans* standard = nullptr;
  for (const SettingMeans& m : means) {
    if (m.setting == "standard") standard = &m;
    if (!m.knob.empty() && std::find(knobs.begin(), knobs.end(), m.knob) == knobs.end()) knobs.push_back(m.knob);
  }
  constexpr double row = 20, head = 30, label = 190, bars = 250;
  double height = 60;
  for (const std::string& knob : knobs)
    height +=
        head + row * (1 + static_cast<double>(std::count_if(means.begin(), means.end(),
                                                            [&](const SettingMeans& m) { return m.knob == knob; })));
  Drawing d(static_cast<int>(label + 2 * bars + 140), static_cast<int>(height));
  double most_mm = 0, most_ms = 0;
  for (const SettingMeans& m : means)
    if (!m.knob.empty() || &m == standard)
      most_mm = std::max(most_mm, m.mean_mm), most_ms = std::max(most_ms, m.sewing_ms);
  const auto error_at = [&](double v) { return label + bars * v / std::max(most_mm, 1e-9); };
  const auto time_at = [&](double v) { return label + bars + 70 + bars * v / std::max(most_ms, 1e-9); };
  d.words({label, 24}, "mean distance to the reference [mm]", ink, Anchor::start, 13);
  d.words({time_at(0), 24}, "sewing [ms]", ink, Anchor::start, 13);
  if (spread_mm > 0 && spread_mm < most_mm)
    d.line({{error_at(spread_mm), 34}, {error_at(spread_mm), height - 10}}, grey, 1);
  double y = 40;
  const auto show = [&](const SettingMeans& m, const std::string& name, const std::string& colour) {
    y += row;
    d.words({label - 8, y}, name, ink, Anchor::end);
    if (m.with_reference == 0) return;
    d.line({{error_at(0), y - 4}, {std::max(error_at(m.mean_mm), error_at(0) + 1), y - 4}}, colour, 9);
    d.words({error_at(m.mean_mm) + 6, y}, text("%.2f", m.mean_mm), ink, Anchor::start, 11);
    d.line({{time_at(0), y - 4}, {std::max(time_at(m.sewing_ms), time_at(0) + 1), y - 4}}, colour, 9);
    d.words({time_at(m.sewing_ms) + 6, y}, text("%.0f", m.sewing_ms), ink, Anchor::start, 11);
  };
  for (const std::string& knob : knobs) {
    y += head - 10;
    d.words({12, y}, knob, ink, Anchor::start, 13);
    if (standard) show(*standard, "standard", named);
    for (const SettingMeans& m : means)
      if (m.knob == knob) show(m, m.value, setting_colour);
    y += 10;
  }
  return d;
}

}  // namespace vitrine::accuracy
