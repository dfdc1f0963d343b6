// SPDX-License-Identifier: GPL-3.0-or-later
#include "image_root.hpp"

#include <algorithm>
#include <filesystem>

#include "text.hpp"

namespace vitrine::input {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_files = 2'000'000;
constexpr int deepest_folder = 32;

bool below(const std::string& file, const std::string& root) {
  return root == "/" ||
         (file.size() > root.size() && file.compare(0, root.size(), root) == 0 && file[root.size()] == '/');
}

}  // namespace

bool is_picture(std::string_view name) {
  const auto dot = name.rfind('.');
  if (dot == std::string_view::npos || dot == 0) return false;
  const std::string end = lower(std::string(name.substr(dot + 1)));
  for (const char* known : {"jpg", "jpeg", "png", "webp", "tif", "tiff", "bmp"})
    if (end == known) return true;
  return false;
}

std::vector<std::string> path_parts(std::string_view source) {
  const auto scheme = source.find("://");
  const bool url = scheme != std::string_view::npos && scheme > 0 && scheme <= 10 &&
                   std::all_of(source.begin(), source.begin() + static_cast<std::ptrdiff_t>(scheme), [](char c) {
                     return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '+' || c == '-' || c == '.' ||
                            (c >= '0' && c <= '9');
                   });
  const bool network = source.substr(0, 2) == "//";
  std::string path(source);
  if (url || network) {
    const auto host = url ? scheme + 3 : 2;
    const auto slash = source.find('/', host);
    std::string_view rest = slash == std::string_view::npos ? "" : source.substr(slash);
    rest = rest.substr(0, rest.find_first_of("?#"));
    path = percent_decoded(rest);
  }
  std::replace(path.begin(), path.end(), '\\', '/');
  if (has_control(path)) return {};
  std::vector<std::string> parts;
  for (std::size_t first = 0; first <= path.size();) {
    const auto end = std::min(path.find('/', first), path.size());
    std::string part = path.substr(first, end - first);
    if (part == "..") return {};
    if (!part.empty() && part != ".") parts.push_back(std::move(part));
    first = end + 1;
  }
  return parts;
}

Result<ImageRoot> ImageRoot::open(const std::string& folder) {
  std::error_code failed;
  const fs::path root = fs::canonical(folder, failed);
  if (failed || !fs::is_directory(root, failed))
    return Error{Cause::missing, "IMAGE_ROOT", folder + ": there is no such folder",
                 "Give the folder with the feed's pictures as --image-root.", "catalog"};
  ImageRoot all;
  all.folder_ = root.string();
  const auto add = [&](const std::string& path, const std::string& file) {
    all.files_.emplace(path, file);
    const std::string name = path.substr(path.rfind('/') + 1);
    const auto [entry, fresh] = all.only_name_.emplace(name, path);
    if (!fresh) entry->second.clear();
  };
  struct Level {
    std::string path;  // below the root, "" or ending with a slash
    int depth;
  };
  std::vector<Level> open{{"", 0}};
  while (!open.empty()) {
    const Level level = std::move(open.back());
    open.pop_back();
    // A folder that may not be read has no pictures for us: what a feed names from it is then missing, and said so.
    for (fs::directory_iterator entry(root / level.path, failed), end; !failed && entry != end;
         entry.increment(failed)) {
      const std::string name = entry->path().filename().string();
      const std::string path = level.path + name;
      std::error_code unknown;
      if (entry->is_symlink(unknown)) {
        const fs::path target = fs::canonical(entry->path(), unknown);
        if (!unknown && below(target.string(), all.folder_) && fs::is_regular_file(target, unknown))
          add(path, target.string());
      } else if (entry->is_directory(unknown)) {
        if (level.depth < deepest_folder) open.push_back({path + "/", level.depth + 1});
      } else if (entry->is_regular_file(unknown)) {
        add(path, "");
      }
      if (all.files_.size() > max_files)
        return bad("IMAGE_ROOT_TOO_LARGE", folder, "there are more than 2,000,000 files below this folder",
                   "Give a folder closer to the pictures.");
    }
  }
  return all;
}

ImageRoot::Found ImageRoot::find(std::string_view source) const {
  const std::vector<std::string> parts = path_parts(source);
  const std::string shown = one_line(source, 200);
  if (parts.empty()) return {"", "\"" + shown + "\" names no file below " + folder_};
  std::string path;
  for (const std::string& part : parts) path += (path.empty() ? "" : "/") + part;
  for (std::size_t first = 0; first != std::string::npos;) {
    const auto found = files_.find(path.substr(first));
    if (found != files_.end())
      return {found->second.empty() ? folder_ + (folder_ == "/" ? "" : "/") + found->first : found->second, ""};
    const auto slash = path.find('/', first);
    first = slash == std::string::npos ? slash : slash + 1;
  }
  const auto only = only_name_.find(parts.back());
  if (only == only_name_.end()) return {"", "there is no \"" + one_line(parts.back(), 120) + "\" below " + folder_};
  if (only->second.empty())
    return {"", "there are several \"" + one_line(parts.back(), 120) + "\" below " + folder_ + ", and none where \"" +
                    shown + "\" says"};
  return find(only->second);
}

std::vector<std::string> ImageRoot::files() const {
  std::vector<std::string> all;
  for (const auto& [path, file] : files_) all.push_back(path);
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace vitrine::input
