// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/host/lock.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "vitrine/host/registry.hpp"

namespace vitrine {
namespace {

constexpr const char* first_line = "vitrine-plugins-lock 1";
constexpr std::size_t longest_line = 512, most_lines = 4096;

bool is_hash(const std::string& text) {
  return text.size() == 64 &&
         std::all_of(text.begin(), text.end(), [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

}  // namespace

std::string lock_text(const PluginRegistry& registry) {
  std::string text = std::string(first_line) + "\n# sha256  plugin  version\n";
  for (const PluginIdentity& plugin : registry.plugins())
    text += plugin.sha256 + "  " + plugin.id + "  " + plugin.version + "\n";
  return text;
}

Result<std::vector<LockedPlugin>> read_lock(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in)
    return Error{Cause::missing, "MISSING", file.string() + ": the lock file cannot be read",
                 "check the path, or write one with vitrine plugin lock --out " + file.string(), "plugin"};
  std::vector<LockedPlugin> locked;
  std::size_t number = 0;
  const auto broken = [&](const std::string& what) {
    return Error{Cause::plugin, "PLUGIN_LOCK_FORM", file.string() + ", line " + std::to_string(number) + ": " + what,
                 "write it anew with vitrine plugin lock --out FILE", "plugin"};
  };
  for (std::string line; std::getline(in, line);) {
    if (++number > most_lines || line.size() > longest_line) return broken("the file is too long for a lock");
    if (number == 1) {
      if (line != first_line) return broken("it does not begin with \"" + std::string(first_line) + "\"");
      continue;
    }
    std::istringstream words(line);
    LockedPlugin row;
    std::string more;
    if (!(words >> row.sha256) || row.sha256[0] == '#') continue;
    if (!(words >> row.id >> row.version) || (words >> more) || !is_hash(row.sha256))
      return broken("expected a SHA-256, a plugin id and a version");
    for (const LockedPlugin& other : locked)
      if (other.id == row.id) return broken("the plugin \"" + row.id + "\" is locked twice");
    locked.push_back(std::move(row));
  }
  if (number == 0) return broken("it is empty");
  return locked;
}

}  // namespace vitrine
