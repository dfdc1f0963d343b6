// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>

namespace vitrine::cli {

/// `vitrine plugin new NAME`: a project to start a plugin from.
void add_plugin_new(CLI::App& plugin_command, int& exit_code);

}  // namespace vitrine::cli
