// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "vitrine/host/adopt.hpp"

namespace vitrine::test {

/// Whose table it is, in errors and descriptions.
inline const PluginIdentity identity{"some.vitrine.so", "org.example.some", "1.2.3", "Example"};

/// Where the build puts the plugins that ship.
inline const std::filesystem::path shipped = std::filesystem::path(VITRINE_BINARY_DIR) / "lib/vitrine-1/plugins";

}  // namespace vitrine::test
