// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "vitrine/catalog_input.hpp"

namespace vitrine::cli {

/// How an input is read, for every command that takes one.
struct InputFlags {
  std::string rules, image_root, kind = "auto";
  void add_to(CLI::App& app);
  InputOptions options() const;
};

/// Adds `plan` and `feed` to `vitrine catalog`.
void add_catalog_input(CLI::App& catalog, int& exit_code);

}  // namespace vitrine::cli
