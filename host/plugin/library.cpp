// SPDX-License-Identifier: GPL-3.0-or-later
// The only file that knows Boost.DLL. Its headers use these without including them when they are told to use std's
// paths.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>
#define BOOST_DLL_USE_STD_FS
#include <link.h>

#include <boost/dll/shared_library.hpp>

#include "vitrine/abi.h"
#include "vitrine/host/elf.hpp"
#include "vitrine/host/library.hpp"

namespace vitrine {

namespace {

struct Kept {
  PluginFile file;
  boost::dll::shared_library library;
};

/// Never destroyed: copies of a plugin's tables are complete, but nothing promises that a plugin holds no other pointer
/// that the process still uses, and unloading at exit runs in no order. The file stays open as well: the linker knows
/// the library by its number, which must not come to mean another file.
void keep_for_ever(PluginFile file, boost::dll::shared_library library) {
  static auto& kept = *new std::vector<Kept>;
  file.bytes.clear();
  kept.push_back({std::move(file), std::move(library)});
}

/// The segments of the library that holds `address`.
std::vector<MemoryRange> image_around(const void* address) {
  struct Search {
    std::uintptr_t address;
    std::vector<MemoryRange> found;
  } search{reinterpret_cast<std::uintptr_t>(address), {}};
  ::dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* data) {
        auto& wanted = *static_cast<Search*>(data);
        std::vector<MemoryRange> image;
        bool here = false;
        for (int i = 0; i < info->dlpi_phnum; ++i) {
          const ElfW(Phdr)& segment = info->dlpi_phdr[i];
          if (segment.p_type != PT_LOAD || (segment.p_flags & PF_R) == 0) continue;
          const std::uintptr_t begin = info->dlpi_addr + segment.p_vaddr;
          image.push_back({begin, begin + segment.p_memsz});
          here = here || image.back().holds(wanted.address, 1);
        }
        if (here) wanted.found = std::move(image);
        return here ? 1 : 0;
      },
      &search);
  return search.found;
}

Error refused(const char* code, const PluginFile& file, const std::string& why, const char* remedy) {
  return {Cause::plugin, code, "plugin file " + file.path.string() + " " + why, remedy, "plugin"};
}

/// The dynamic linker's own words, which Boost wraps as "... (dlerror system message: WORDS): Bad file descriptor".
std::string reason(const std::string& what) {
  const std::string opening = "dlerror system message: ";
  const std::size_t begin = what.find(opening), end = what.rfind(')');
  if (begin == std::string::npos || end == std::string::npos || end < begin + opening.size()) return what;
  return what.substr(begin + opening.size(), end - begin - opening.size());
}

}  // namespace

Result<LoadedPlugin> load_library(const PluginFile& file) {
  constexpr const char* rebuild =
      "Build it again for this machine with vitrine_add_plugin(), which also finds undefined symbols";
  const std::string problem = elf_problem(file.bytes);
  if (!problem.empty()) return refused("PLUGIN_FILE_LOAD", file, "cannot be loaded: " + problem, rebuild);
  const std::string opened = "/proc/self/fd/" + std::to_string(*file.handle);
  try {
    // now: an undefined symbol has to fail here, not kill the process at a call. local: plugins must not see each
    // other. The overload that throws: the one with an error_code reports "Bad file descriptor" whatever the cause is.
    boost::dll::shared_library library(opened, boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local);
    const bool has_entry = library.has(VITRINE_ENTRY_SYMBOL);
    LoadedPlugin loaded;
    if (has_entry) loaded.entry = &library.get<const vitrine_plugin>(VITRINE_ENTRY_SYMBOL);
    keep_for_ever(file, std::move(library));
    if (!has_entry)
      return refused("PLUGIN_FILE_ENTRY", file,
                     "does not export " VITRINE_ENTRY_SYMBOL ", so it is a library but no plugin",
                     "Build it with vitrine_add_plugin() and define the entry with VITRINE_PLUGIN");
    loaded.image = image_around(loaded.entry);
    return loaded;
  } catch (const std::exception& e) {
    std::string why = reason(e.what());
    if (const std::size_t at = why.find(opened); at != std::string::npos)
      why.replace(at, opened.size(), file.path.filename().string());
    return refused("PLUGIN_FILE_LOAD", file, "cannot be loaded: " + why, rebuild);
  } catch (...) {
    return refused("PLUGIN_FILE_LOAD", file, "cannot be loaded: a static constructor threw", rebuild);
  }
}

}  // namespace vitrine
