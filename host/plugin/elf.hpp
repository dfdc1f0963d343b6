// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

namespace vitrine {

/// Why a file is not a whole shared library of this kind of machine; empty if it is one as far as its headers tell. The
/// dynamic linker maps what the headers promise without looking at the file's length, so a library that was cut off
/// (a broken download) ends the process with SIGBUS instead of an error.
std::string elf_problem(const std::filesystem::path& file);

}  // namespace vitrine
