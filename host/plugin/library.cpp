// SPDX-License-Identifier: GPL-3.0-or-later
// The only file that knows Boost.DLL. Its headers use these without including them when they are told to use std's
// paths.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>
#define BOOST_DLL_USE_STD_FS
#include <boost/dll/shared_library.hpp>

#include "elf.hpp"
#include "library.hpp"
#include "vitrine/abi.h"

namespace vitrine {

namespace {

/// Never destroyed: copies of a plugin's tables are complete, but nothing promises that a plugin holds no other pointer
/// that the process still uses, and unloading at exit runs in no order.
void keep_for_ever(boost::dll::shared_library library) {
  static auto& kept = *new std::vector<boost::dll::shared_library>;
  kept.push_back(std::move(library));
}

Error refused(const char* code, const std::filesystem::path& file, const std::string& why, const char* remedy) {
  return {Cause::plugin, code, "plugin file " + file.string() + " " + why, remedy, "plugin"};
}

/// The dynamic linker's own words, which Boost wraps as "... (dlerror system message: WORDS): Bad file descriptor".
std::string reason(const std::string& what) {
  const std::string opening = "dlerror system message: ";
  const std::size_t begin = what.find(opening), end = what.rfind(')');
  if (begin == std::string::npos || end == std::string::npos || end < begin + opening.size()) return what;
  return what.substr(begin + opening.size(), end - begin - opening.size());
}

}  // namespace

Result<const void*> load_entry(const std::filesystem::path& absolute_file) {
  constexpr const char* rebuild =
      "Build it again for this machine with vitrine_add_plugin(), which also finds undefined symbols";
  const std::string problem = elf_problem(absolute_file);
  if (!problem.empty()) return refused("PLUGIN_FILE_LOAD", absolute_file, "cannot be loaded: " + problem, rebuild);
  try {
    // now: an undefined symbol has to fail here, not kill the process at a call. local: plugins must not see each
    // other. The overload that throws: the one with an error_code reports "Bad file descriptor" whatever the cause is.
    boost::dll::shared_library library(absolute_file,
                                       boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local);
    const bool has_entry = library.has(VITRINE_ENTRY_SYMBOL);
    const void* entry = has_entry ? &library.get<const vitrine_plugin>(VITRINE_ENTRY_SYMBOL) : nullptr;
    keep_for_ever(std::move(library));
    if (!has_entry)
      return refused("PLUGIN_FILE_ENTRY", absolute_file,
                     "does not export " VITRINE_ENTRY_SYMBOL ", so it is a library but no plugin",
                     "Build it with vitrine_add_plugin() and define the entry with VITRINE_PLUGIN");
    return entry;
  } catch (const std::exception& e) {
    return refused("PLUGIN_FILE_LOAD", absolute_file, "cannot be loaded: " + reason(e.what()), rebuild);
  }
}

}  // namespace vitrine
