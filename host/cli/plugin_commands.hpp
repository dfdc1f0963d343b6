// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>

namespace vitrine::cli {

/// Subcommands of `vitrine plugin` that have a file of their own.
void add_plugin_inspect(CLI::App& command, int& exit_code);
void add_plugin_validate(CLI::App& command, int& exit_code);

}  // namespace vitrine::cli
