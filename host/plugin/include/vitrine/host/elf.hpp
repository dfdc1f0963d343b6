// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace vitrine {

/// Why a file is not a whole shared library of this kind of machine; empty if it is one as far as its headers tell. The
/// dynamic linker maps what the headers promise without looking at the file's length, so a library that was cut off
/// (a broken download) ends the process with SIGBUS instead of an error.
std::string elf_problem(std::span<const std::uint8_t> file);

/// What a shared library's tables say of it, read from the file without loading it. Names are sorted.
struct ElfFacts {
  std::vector<std::string> exported;  ///< defined symbols that others can bind to
  std::vector<std::string>
      unanswered;                   ///< undefined, not weak, and of no library that it names: the host's, or nobody's
  std::vector<std::string> needed;  ///< libraries that it names (DT_NEEDED)
  std::vector<std::string> search;  ///< DT_RPATH and DT_RUNPATH
  bool executable_stack = false;    ///< PT_GNU_STACK asks for one, or is missing
  bool writable_code = false;       ///< a segment is both writable and executable, or code is relocated
  std::uint64_t image_bytes = 0;    ///< memory that its segments take
};

/// Facts of a file without elf_problem(). Offsets that point outside of the file are treated as absent.
ElfFacts elf_facts(std::span<const std::uint8_t> file);

}  // namespace vitrine
