// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/host/registry.hpp"

#include <algorithm>

#include "library.hpp"
#include "search.hpp"

namespace vitrine {

namespace fs = std::filesystem;

namespace {

template <class Table>
auto* find_by_id(const Table& table, std::string_view id) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const auto& row) { return row.id == id; });
  return found == table.end() ? nullptr : &*found;
}

template <class Table>
void sort_by_id(Table& table) {
  std::sort(table.begin(), table.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
}

}  // namespace

PluginRegistry PluginRegistry::load(const PluginSearch& search) {
  PluginRegistry registry;
  for (const fs::path& file : search.files) registry.add(file, true);
  const auto add_folder = [&](const fs::path& folder, bool requested) {
    const auto files = plugin_files_in(folder);
    if (!files) {
      registry.rejected_.push_back({folder.string(), files.error(), requested});
      return;
    }
    for (const fs::path& file : *files) registry.add(file, false);
  };
  for (const fs::path& folder : search.folders) add_folder(folder, true);
  if (search.built_in) {
    const fs::path folder = built_in_plugin_folder();
    std::error_code failed;
    // A program without a plugin folder is not broken: its plugins may all come from the command line.
    if (!folder.empty() && fs::exists(folder, failed)) add_folder(folder, false);
  }
  sort_by_id(registry.plugins_);
  sort_by_id(registry.garments_);
  sort_by_id(registry.necklines_);
  return registry;
}

void PluginRegistry::add(const fs::path& file, bool requested) {
  const auto reject = [&](const Error& error) { rejected_.push_back({file.string(), error, requested}); };
  const auto trusted = trusted_plugin_file(file);
  if (!trusted) return reject(trusted.error());
  const std::string path = trusted->string();
  // The same file by two ways (named, and in a folder) is one plugin, not a duplicate.
  if (std::any_of(plugins_.begin(), plugins_.end(), [&](const PluginIdentity& p) { return p.file == path; })) return;
  const auto entry = load_entry(*trusted);
  if (!entry) return reject(entry.error());
  auto plugin = adopt(*entry, path);
  if (!plugin) return reject(plugin.error());
  if (const auto error = duplicate(*plugin)) return reject(*error);
  plugins_.push_back(plugin->identity);
  for (GarmentTemplate& garment : plugin->garments) garments_.push_back(std::move(garment));
  for (NecklineTemplate& neckline : plugin->necklines) necklines_.push_back(std::move(neckline));
}

std::optional<Error> PluginRegistry::duplicate(const AdoptedPlugin& plugin) const {
  const auto clash = [&](const std::string& kind, const std::string& id, const std::string& first) {
    return Error{Cause::plugin, "PLUGIN_DUPLICATE_ID",
                 kind + " \"" + id + "\" is supplied by two files: " + first + " and " + plugin.identity.file,
                 "Remove one of the two files, or give one of them another id", "plugin"};
  };
  if (find_by_id(plugins_, plugin.identity.id)) return clash("plugin", plugin.identity.id, file_of(plugin.identity.id));
  for (const GarmentTemplate& garment : plugin.garments)
    if (const auto* first = find_by_id(garments_, garment.id))
      return clash("garment", garment.id, file_of(first->plugin));
  for (const NecklineTemplate& neckline : plugin.necklines)
    if (const auto* first = find_by_id(necklines_, neckline.id))
      return clash("neckline", neckline.id, file_of(first->plugin));
  return std::nullopt;
}

std::string PluginRegistry::file_of(const std::string& plugin_id) const {
  const PluginIdentity* plugin = find_by_id(plugins_, plugin_id);
  return plugin ? plugin->file : std::string();
}

const GarmentTemplate* PluginRegistry::find_garment(std::string_view id) const {
  return find_by_id(garments_, id);
}
const NecklineTemplate* PluginRegistry::find_neckline(std::string_view id) const {
  return find_by_id(necklines_, id);
}

std::optional<Error> PluginRegistry::problem() const {
  for (const RejectedPlugin& rejected : rejected_)
    if (rejected.requested || rejected.error.code == "PLUGIN_DUPLICATE_ID") return rejected.error;
  return std::nullopt;
}

}  // namespace vitrine
