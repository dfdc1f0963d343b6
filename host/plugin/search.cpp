// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/host/search.hpp"

#include <fcntl.h>
#include <grp.h>
#include <openssl/sha.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
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

Error missing(const fs::path& path, const char* kind, int number) {
  return refused("PLUGIN_FILE_MISSING",
                 std::string("plugin ") + kind + " " + path.string() + ": " + std::strerror(number),
                 "Check the path and that you may read it");
}

/// A plugin runs with the user's rights, so whoever can change it or swap it in its folder owns the user's account.
std::optional<Error> distrust(const fs::path& path, const struct stat& status, const char* kind) {
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

std::optional<Error> distrust_folder(const fs::path& folder) {
  struct stat status {};
  if (::stat(folder.c_str(), &status) != 0) return missing(folder, "folder", errno);
  return distrust(folder, status, "folder");
}

/// Where every user has a group of their own, as Debian sets them up, its right to write is the user's own.
bool is_own_group(gid_t group) {
  if (group == 0) return true;
  const passwd* user = ::getpwuid(::geteuid());
  const ::group* entry = ::getgrgid(group);
  return user != nullptr && entry != nullptr && user->pw_gid == group &&
         std::strcmp(user->pw_name, entry->gr_name) == 0 && entry->gr_mem[0] == nullptr;
}

/// The folders above: whoever may rename there can put another folder in this one's place.
std::optional<Error> distrust_folders_above(const fs::path& folder) {
  for (fs::path above = folder.parent_path();; above = above.parent_path()) {
    struct stat status {};
    if (::stat(above.c_str(), &status) != 0) return missing(above, "folder", errno);
    const bool owned = status.st_uid == 0 || status.st_uid == ::geteuid();
    // In a sticky folder only a file's owner may rename it, and the one below is root's or the user's.
    const bool swappable =
        (status.st_mode & S_ISVTX) == 0 &&
        ((status.st_mode & S_IWOTH) != 0 || ((status.st_mode & S_IWGRP) != 0 && !is_own_group(status.st_gid)));
    if (!owned || swappable)
      return refused("PLUGIN_FILE_TRUST",
                     "plugin folder " + folder.string() + " can be swapped by other users, through " + above.string(),
                     "Move the plugins below a folder that only you or root can change, or, if you trust it: chmod " +
                         std::string("go-w ") + above.string());
    if (above == above.root_path()) return std::nullopt;
  }
}

std::string hex(const unsigned char* digest, std::size_t size) {
  std::string text;
  for (std::size_t i = 0; i < size; ++i) {
    text += "0123456789abcdef"[digest[i] >> 4];
    text += "0123456789abcdef"[digest[i] & 15];
  }
  return text;
}

}  // namespace

Result<PluginFile> open_plugin_file(const fs::path& file) {
  if (!file.string().ends_with(suffix))
    return refused("PLUGIN_FILE_NAME", "plugin file " + file.string() + " does not end in " + std::string(suffix),
                   "Name a file built with vitrine_add_plugin()");
  if (!file.has_parent_path())
    return refused("PLUGIN_FILE_NAME", "plugin file " + file.string() + " is named without its folder",
                   "Write ./" + file.string() + " if you mean the one in the current folder");
  std::error_code failed;
  PluginFile plugin;
  plugin.path = fs::canonical(file, failed);
  if (failed)
    return refused("PLUGIN_FILE_MISSING", "plugin file " + file.string() + ": " + failed.message(),
                   "Check the path and that you may read it");
  // Without waiting: the name may be a pipe's.
  const int fd = ::open(plugin.path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (fd < 0) return missing(plugin.path, "file", errno);
  plugin.handle = std::shared_ptr<const int>(new int(fd), [](const int* open) {
    ::close(*open);
    delete open;
  });
  struct stat status {};
  if (::fstat(fd, &status) != 0) return missing(plugin.path, "file", errno);
  if (!S_ISREG(status.st_mode))
    return refused("PLUGIN_FILE_KIND", "plugin file " + plugin.path.string() + " is not a regular file",
                   "Name a file built with vitrine_add_plugin()");
  if (auto error = distrust(plugin.path, status, "file")) return *error;
  const fs::path folder = plugin.path.parent_path();
  if (auto error = distrust_folder(folder)) return *error;
  if (auto error = distrust_folders_above(folder)) return *error;
  if (static_cast<std::uint64_t>(status.st_size) > max_plugin_bytes)
    return refused("PLUGIN_FILE_SIZE",
                   "plugin file " + plugin.path.string() + " has " + std::to_string(status.st_size) +
                       " bytes, allowed are " + std::to_string(max_plugin_bytes),
                   "Build it without debug information and without what it does not need");
  plugin.bytes.resize(static_cast<std::size_t>(status.st_size));
  for (std::size_t done = 0; done < plugin.bytes.size();) {
    const ssize_t n = ::pread(fd, plugin.bytes.data() + done, plugin.bytes.size() - done, static_cast<off_t>(done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return missing(plugin.path, "file", errno);
    if (n == 0) plugin.bytes.resize(done);  // it became shorter meanwhile
    done += static_cast<std::size_t>(n);
  }
  unsigned char digest[SHA256_DIGEST_LENGTH];
  ::SHA256(plugin.bytes.data(), plugin.bytes.size(), digest);
  plugin.sha256 = hex(digest, sizeof digest);
  return plugin;
}

Result<std::vector<fs::path>> plugin_files_in(const fs::path& folder) {
  std::error_code failed;
  const fs::path real = fs::canonical(folder, failed);
  if (failed || !fs::is_directory(real, failed))
    return refused("PLUGIN_FOLDER_MISSING", "plugin folder " + folder.string() + " does not exist or is not a folder",
                   "Check the path");
  if (auto error = distrust_folder(real)) return *error;
  if (auto error = distrust_folders_above(real)) return *error;
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
