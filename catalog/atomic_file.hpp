// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "vitrine/model/result.hpp"

namespace vitrine {

/// The file's bytes; empty when it cannot be read.
std::string read_whole(const std::filesystem::path& file);

/// Writes to a temporary name beside `file` and renames; with `durable`, not before the bytes are on the disk. Error:
/// REPORT (73).
std::optional<Error> write_atomically(const std::filesystem::path& file, std::string_view text, bool durable = false);

}  // namespace vitrine
