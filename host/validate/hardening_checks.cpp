// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include "process_state.hpp"
#include "session.hpp"
#include "vitrine/abi.h"
#include "vitrine/host/elf.hpp"

namespace vitrine::validation {
namespace {

constexpr std::uint64_t most_image = 16u << 20;  // [byte]

/// The run-time libraries of C and C++; a plugin that needs more is more than a table.
constexpr auto language_libraries =
    std::to_array<std::string_view>({"libc.so", "libm.so", "libgcc_s.so", "libstdc++.so", "libc++.so", "libc++abi.so",
                                     "ld-linux", "libpthread.so", "libdl.so", "librt.so"});

bool is_language_library(const std::string& name) {
  return std::any_of(language_libraries.begin(), language_libraries.end(),
                     [&](std::string_view known) { return name.starts_with(known); });
}

}  // namespace

void check_hardening(const Session& session, const Subject& subject) {
  session.begin("hardening.exports");
  const ElfFacts facts = elf_facts(subject.file.bytes);
  std::vector<std::string> findings;
  for (const std::string& name : facts.exported)
    if (name != VITRINE_ENTRY_SYMBOL) findings.push_back("it exports " + name);
  session.conclude("hardening.exports", findings);

  findings.clear();
  for (const std::string& name : facts.needed)
    if (!is_language_library(name)) findings.push_back("it needs " + name);
  for (const std::string& name : facts.unanswered)
    findings.push_back("no library that it needs has the symbol " + name);
  session.conclude("hardening.needs", findings);

  findings.clear();
  for (const std::string& path : facts.search) findings.push_back("it looks for libraries in " + path);
  session.conclude("hardening.search", findings);

  findings.clear();
  if (facts.executable_stack) findings.push_back("it asks for an executable stack");
  if (facts.writable_code) findings.push_back("a segment is both writable and executable");
  session.conclude("hardening.segments", findings);

  findings.clear();
  if (facts.image_bytes > most_image)
    findings.push_back("its image takes " + std::to_string(facts.image_bytes >> 20) + " MB");
  session.conclude("hardening.size", findings, std::to_string((facts.image_bytes + 1023) / 1024) + " kB");

  session.begin("hardening.readonly");
  findings.clear();
  const std::vector<Mapping> maps = mappings();
  const Mapping* last = nullptr;
  for (const MemoryRange& range : subject.tables)
    for (const Mapping& map : maps)
      if (map.writable && range.begin < map.end && range.end > map.begin && &map != last) {
        findings.push_back(
            "a table lies in writable memory; declare tables const, and write out the type of a constexpr "
            "std::array (GCC leaves one whose type it deduces writable)");
        last = &map;
      }
  session.conclude("hardening.readonly", findings);
}

void check_stays(const Session& session, const Subject& subject) {
  session.begin("hardening.stays");
  const auto entry = reinterpret_cast<std::uintptr_t>(subject.library.entry);
  const std::vector<Mapping> maps = mappings();
  const auto map =
      std::find_if(maps.begin(), maps.end(), [&](const Mapping& m) { return entry >= m.begin && entry < m.end; });
  const bool here = map != maps.end() && map->file.ends_with(subject.file.path.filename().string());
  session.conclude("hardening.stays",
                   here ? std::vector<std::string>{} : std::vector<std::string>{"its image is no longer in memory"});
}

}  // namespace vitrine::validation
