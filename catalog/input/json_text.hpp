// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "vitrine/model/result.hpp"

namespace vitrine::input {

/// Parses JSON from strangers: UTF-8, at most 16 levels deep, numbers finite. `object_lines` receives
/// the line on which each object begins, in the order they begin. Error (65, `code`) with file, line and column.
Result<nlohmann::json> parse_json(std::string_view text, const std::string& file, const char* code,
                                  std::vector<int>* object_lines = nullptr);

}  // namespace vitrine::input
