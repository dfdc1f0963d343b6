// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>

#include "vitrine/pipeline.hpp"

namespace vitrine {

/// Work [node steps] of all rooms but the sewing, from what the photos and the request say before anything is sewn.
double work_of_rooms(const ConvertRequest& request, const Conversion& item);

/// What a finished drape has made of the budget; appends the warnings of what was missed.
BudgetFigures judge_budget(const ConvertRequest& request, const Drape& drape, double rooms,
                           std::vector<std::string>& warnings);

nlohmann::ordered_json budget_as_json(const ConvertRequest& request, const Conversion& item);

}  // namespace vitrine
