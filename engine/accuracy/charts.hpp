// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "drawing.hpp"
#include "vitrine/accuracy.hpp"

namespace vitrine::accuracy {

/// Mean distance to the reference against processor time, both axes by decades: every run a small dot, the mean of each
/// setting a large one, the front of what no other setting undercuts a line.
Drawing pareto_chart(const std::vector<RunRow>& runs, const std::vector<SettingMeans>& means, double spread_mm);

/// One panel for each knob: error and sewing time of its values beside standard's.
Drawing knobs_chart(const std::vector<SettingMeans>& means, double spread_mm);

}  // namespace vitrine::accuracy
