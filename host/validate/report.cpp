// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "vitrine/abi.h"
#include "vitrine/validate.hpp"

namespace vitrine {
namespace {

const char* name_of(CheckStatus status) {
  switch (status) {
    case CheckStatus::passed:
      return "passed";
    case CheckStatus::failed:
      return "failed";
    case CheckStatus::skipped:
      break;
  }
  return "skipped";
}

}  // namespace

std::string validation_text(const Validation& validation, bool all) {
  std::string text;
  for (const FileReport& file : validation.files) {
    text += file.file;
    if (!file.id.empty()) text += " (" + file.id + " " + file.version + ")";
    int counts[3] = {0, 0, 0};
    for (const CheckResult& check : file.checks) ++counts[static_cast<int>(check.status)];
    text += ": " + std::to_string(counts[0]) + " passed, " + std::to_string(counts[1]) + " failed, " +
            std::to_string(counts[2]) + " skipped\n";
    for (const CheckResult& check : file.checks) {
      if (!all && check.status != CheckStatus::failed) continue;
      text += std::string("  ") + name_of(check.status) + "  " + check.name;
      if (!check.message.empty()) text += ": " + check.message;
      text += '\n';
    }
  }
  if (validation.passed + validation.failed + validation.skipped == 0) text += "nothing was checked\n";
  return text + std::to_string(validation.passed) + " passed, " + std::to_string(validation.failed) + " failed, " +
         std::to_string(validation.skipped) + " skipped\n";
}

std::string validation_json(const Validation& validation, const ValidateOptions& options, const std::string& version) {
  using nlohmann::ordered_json;
  ordered_json json{{"tool", "vitrine " + version},
                    {"abi", std::to_string(VITRINE_ABI_MAJOR) + "." + std::to_string(VITRINE_ABI_MINOR)},
                    {"level", options.level},
                    {"seed", options.seed},
                    {"ok", validation.ok()},
                    {"passed", validation.passed},
                    {"failed", validation.failed},
                    {"skipped", validation.skipped},
                    {"files", ordered_json::array()}};
  for (const FileReport& file : validation.files) {
    ordered_json checks = ordered_json::array();
    for (const CheckResult& check : file.checks)
      checks.push_back({{"name", check.name},
                        {"level", check.level},
                        {"status", name_of(check.status)},
                        {"message", check.message}});
    json["files"].push_back({{"file", file.file},
                             {"id", file.id},
                             {"version", file.version},
                             {"sha256", file.sha256},
                             {"garments", file.garments},
                             {"necklines", file.necklines},
                             {"checks", std::move(checks)}});
  }
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace vitrine
