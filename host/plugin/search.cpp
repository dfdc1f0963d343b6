// SPDX-License-Identifier: GPL-3.0-or-later
#include "search.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <system_error>

#include "vitrine/host/registry.hpp"

namespace vitrine {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view suffix = ".vitrine.so";

Error refused(const char* code, const std::string& message, const std::string& remedy) {
  return {Cause::plugin, code, message, remedy, "plugin"};
}

/// A plugin runs with the user's rights, so whoever can change it or swap it in its folder owns the user's account.
std::optional<Error> distrust(const fs::path& path, const char* kind) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return refused("PLUGIN_FILE_MISSING",
                   std::string("plugin ") + kind + " " + path.string() + ": " + std::strerror(errno),
                   "Check the path and that you may read it");
  if (status.st_uid != 0 && status.st_uid != ::geteuid())
    return refused("PLUGIN_FILE_TRUST",
                   std::string("plugin ") + kind + " " + path.string() + " belongs to user " +
                       std::to_string(status.st_uid) + ", who is neither root nor you",
                   "Copy the plugin to a folder of your own if you trust it");
  if ((status.st_mode & (S_IWGRP | S_IWOTH)) != 0)
    return refused("PLUGIN_FILE_TRUST",
                   std::string("plugin ") + kind + " " + path.string() + " can be changed by other users",
                   "Take their right to write away if you trust it: chmod go-w " + path.string());
  return std::nullopt;
}

}  // namespace

Result<fs::path> trusted_plugin_file(const fs::path& file) {
  if (!file.string().ends_with(suffix))
    return refused("PLUGIN_FILE_NAME", "plugin file " + file.string() + " does not end in " + std::string(suffix),
                   "Name a file built with vitrine_add_plugin()");
  if (!file.has_parent_path())
    return refused("PLUGIN_FILE_NAME", "plugin file " + file.string() + " is named without its folder",
                   "Write ./" + file.string() + " if you mean the one in the current folder");
  std::error_code failed;
  const fs::path real = fs::canonical(file, failed);
  if (failed)
    return refused("PLUGIN_FILE_MISSING", "plugin file " + file.string() + ": " + failed.message(),
                   "Check the path and that you may read it");
  if (!fs::is_regular_file(real, failed))
    return refused("PLUGIN_FILE_KIND", "plugin file " + real.string() + " is not a regular file",
                   "Name a file built with vitrine_add_plugin()");
  if (auto error = distrust(real, "file")) return *error;
  if (auto error = distrust(real.parent_path(), "folder")) return *error;
  return real;
}

Result<std::vector<fs::path>> plugin_files_in(const fs::path& folder) {
  std::error_code failed;
  const fs::path real = fs::canonical(folder, failed);
  if (failed || !fs::is_directory(real, failed))
    return refused("PLUGIN_FOLDER_MISSING", "plugin folder " + folder.string() + " does not exist or is not a folder",
                   "Check the path");
  if (auto error = distrust(real, "folder")) return *error;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(real, failed), end; !failed && entry != end; entry.increment(failed))
    if (entry->path().filename().string().ends_with(suffix)) files.push_back(entry->path());
  if (failed)
    return refused("PLUGIN_FOLDER_MISSING", "plugin folder " + real.string() + ": " + failed.message(),
                   "Check that you may read it");
  // Folders list their entries in no particular order; the result may not depend on it.
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) { return a.native() < b.native(); });
  return files;
}

fs::path built_in_plugin_folder() {
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  if (failed) return {};
  return program.parent_path().parent_path() / "lib" / "vitrine-1" / "plugins";
}

}  // namespace vitrine
