// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <numeric>

#include "vitrine/accuracy.hpp"

namespace vitrine {

std::vector<std::size_t> pareto_front(const std::vector<double>& cost, const std::vector<double>& error) {
  std::vector<std::size_t> order(cost.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(cost[a], error[a], a) < std::tie(cost[b], error[b], b);
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || error[i] < error[front.back()]) front.push_back(i);
  return front;
}

std::vector<SettingMeans> means_by_setting(const std::vector<RunRow>& runs) {
  std::vector<SettingMeans> all;
  for (const RunRow& run : runs) {
    if (run.setting.empty()) continue;
    auto found = std::find_if(all.begin(), all.end(), [&](const SettingMeans& m) { return m.setting == run.setting; });
    if (found == all.end()) {
      found = all.insert(all.end(), SettingMeans{});
      found->setting = run.setting;
      found->knob = run.knob;
      found->value = run.value;
    }
    SettingMeans& m = *found;
    ++m.items;
    if (!run.seam_gap_mm) {  // a room refused
      ++m.refused;
      continue;
    }
    m.nodes += run.nodes;
    m.cpu_ms += run.cpu_ms;
    m.sewing_ms += run.sewing_ms;
    m.peak_mb = std::max(m.peak_mb, run.peak_mb);
    const auto add = [](const std::optional<double>& from, double& to, int& count) {
      if (from) to += *from, ++count;
    };
    if (run.mean_mm) {
      ++m.with_reference;
      m.mean_mm += *run.mean_mm;
      m.p95_mm += run.p95_mm.value_or(0);
      m.max_mm += run.max_mm.value_or(0);
      m.worst_mean_mm = std::max(m.worst_mean_mm, *run.mean_mm);
    }
    add(run.hem_mm, m.hem_mm, m.with_hem);
    add(run.waist_mm, m.waist_mm, m.with_waist);
    add(run.chest_mm, m.chest_mm, m.with_chest);
    add(run.iou, m.iou, m.with_iou);
    m.landmark_mm += run.landmark_mm.value_or(0);
  }
  for (SettingMeans& m : all) {
    const auto divide = [](int count, std::initializer_list<double*> sums) {
      for (double* sum : sums) *sum /= std::max(1, count);
    };
    divide(m.items - m.refused, {&m.nodes, &m.cpu_ms, &m.sewing_ms});
    divide(m.with_reference, {&m.mean_mm, &m.p95_mm, &m.max_mm});
    divide(m.with_hem, {&m.hem_mm});
    divide(m.with_waist, {&m.waist_mm});
    divide(m.with_chest, {&m.chest_mm});
    divide(m.with_iou, {&m.iou, &m.landmark_mm});
  }
  return all;
}

}  // namespace vitrine
