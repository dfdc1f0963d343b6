// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string_view>

#include "common.hpp"

namespace vitrine::cli {
namespace {

namespace fs = std::filesystem;

struct New {
  std::string name, dir;
  bool garment = false, neckline = false;
};

/// <prefix>/share/vitrine-1/starter, the prefix being that of the running program; the same in a build tree.
fs::path starter_folder() {
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  if (failed) return {};
  return program.parent_path().parent_path() / "share" / "vitrine-1" / "starter";
}

bool well_formed(const std::string& name) {
  const auto letter = [](char c) { return c >= 'a' && c <= 'z'; };
  return !name.empty() && name.size() <= 64 && letter(name[0]) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_'; });
}

/// "rain_cape" -> "Rain cape".
std::string title_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  name[0] = static_cast<char>(name[0] - 'a' + 'A');
  return name;
}

std::string filled_in(std::string text, const std::string& name) {
  const std::pair<std::string_view, std::string> places[] = {{"@name@", name}, {"@Title@", title_of(name)}};
  for (const auto& [place, value] : places)
    for (std::size_t at = 0; (at = text.find(place, at)) != std::string::npos; at += value.size())
      text.replace(at, place.size(), value);
  return text;
}

/// Copies the files of one folder of the starter, with the name filled in, into `target`.
std::optional<Error> copy_files(const fs::path& from, const fs::path& target, const std::string& name) {
  std::error_code failed;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(from, failed), end; !failed && entry != end; entry.increment(failed))
    files.push_back(entry->path());
  if (failed || files.empty())
    return Error{Cause::missing, "NO_STARTER",
                 "the starter project is not at " + from.string() + (failed ? ": " + failed.message() : ""),
                 "install the package vitrine-sdk beside the program", ""};
  for (const fs::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const fs::path copy = target / filled_in(file.filename().string(), name);
    std::ofstream out(copy, std::ios::binary);
    out << filled_in(text, name);
    out.close();
    if (!in)
      return Error{Cause::missing, "NO_STARTER", file.string() + ": the file cannot be read",
                   "install the package vitrine-sdk anew", ""};
    if (!out)
      return Error{Cause::unwritable, "CANNOT_WRITE", copy.string() + ": the file cannot be written",
                   "check the folder's permissions and the space on the disk", ""};
  }
  return std::nullopt;
}

std::optional<Error> make_project(const New& a, const fs::path& target) {
  if (!well_formed(a.name))
    return Error{Cause::usage, "USAGE", "\"" + a.name + "\" cannot be a plugin's name",
                 "a name is small letters, digits and _, begins with a letter and has at most 64 of them", ""};
  const PluginRegistry built_in = PluginRegistry::load({});
  if (built_in.find_garment(a.name) || built_in.find_neckline(a.name))
    return Error{Cause::usage, "USAGE", "\"" + a.name + "\" is the id of a garment or neckline that is installed",
                 "choose another name: two plugins with one id are refused", ""};
  std::error_code failed;
  if (fs::exists(target, failed) && !(fs::is_directory(target, failed) && fs::is_empty(target, failed)))
    return Error{Cause::usage, "USAGE", target.string() + " exists and is not an empty folder",
                 "name another folder with --dir; nothing is overwritten", ""};

  const auto unwritable = [&](const fs::path& what, const std::error_code& why) {
    return Error{Cause::unwritable, "CANNOT_WRITE", what.string() + ": " + why.message(),
                 "check the folder's permissions, or name another with --dir", ""};
  };
  // Written aside and renamed, so that there is a whole project or none.
  const fs::path aside = target.string() + ".new-" + std::to_string(::getpid());
  if (target.has_parent_path()) fs::create_directories(target.parent_path(), failed);
  if (!failed) fs::create_directory(aside, failed);
  if (failed) return unwritable(aside, failed);
  auto error = copy_files(starter_folder() / "shared", aside, a.name);
  if (!error) error = copy_files(starter_folder() / (a.neckline ? "neckline" : "garment"), aside, a.name);
  if (!error) {
    fs::rename(aside, target, failed);
    if (failed) error = unwritable(target, failed);
  }
  if (error) fs::remove_all(aside, failed);
  return error;
}

int new_plugin(const New& a) {
  fs::path target = a.dir.empty() ? fs::path(a.name) : fs::path(a.dir).lexically_normal();
  if (!target.has_filename()) target = target.parent_path();  // "dir/" means dir
  if (const auto error = make_project(a, target)) return fail(*error);
  std::cout << target.string() << ": a plugin that builds and passes as it is; its tables are in " << a.name
            << ".cpp\n\n  cd " << target.string()
            << "\n  cmake -B build && cmake --build build && ctest --test-dir build --output-on-failure\n";
  return 0;
}

}  // namespace

void add_plugin_new(CLI::App& plugin_command, int& exit_code) {
  auto a = std::make_shared<New>();
  auto* command = plugin_command.add_subcommand("new", "Write a project to start a garment or neckline plugin from");
  command->add_option("name", a->name, "Id of the new garment or neckline: small letters, digits and _")->required();
  auto* garment = command->add_flag("--garment", a->garment, "A garment (default)");
  command->add_flag("--neckline", a->neckline, "A neckline")->excludes(garment);
  command->add_option("--dir", a->dir, "Folder to write; must not exist, or be empty (default: ./NAME)");
  command->callback([a, &exit_code] { exit_code = new_plugin(*a); });
}

}  // namespace vitrine::cli
