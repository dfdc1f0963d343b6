// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>

#include "vitrine/showroom.hpp"

namespace vitrine::cli {

/// --shop, --language and --photo-root.
void add_showroom_options(CLI::App& app, ShowroomOptions& options);

/// Writes the site and says what is in it; the exit code.
int write_showroom(ShowroomOptions options);

}  // namespace vitrine::cli
