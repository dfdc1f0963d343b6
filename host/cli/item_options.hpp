// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "common.hpp"

namespace vitrine::cli {

/// One item as it is given on the command line: photos, garment, sizes.
struct ItemOptions {
  ConvertRequest request;
  std::string garment, neckline = "auto";
  double chest_cm = 0, length_cm = 0;
  /// `required`: the command makes nothing but one item.
  void add_to(CLI::App& app, bool required);
  /// Error: USAGE (64) when options contradict each other or one is missing.
  std::optional<Error> check() const;
  /// The request with what the registry knows of the garment. Errors: those of choose_garment().
  Result<ConvertRequest> apply(const PluginRegistry& registry) const;
};

}  // namespace vitrine::cli
