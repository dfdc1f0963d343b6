// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/host/registry.hpp"

#include <algorithm>

#include "rehearsal.hpp"

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

std::vector<PluginRegistry::Candidate> PluginRegistry::find(const PluginSearch& search) {
  std::vector<Candidate> candidates;
  const auto add_file = [&](const fs::path& path, bool requested) {
    auto file = open_plugin_file(path);
    if (!file) {
      rejected_.push_back({path.string(), file.error(), requested});
      return;
    }
    // The same file by two ways (named, and in a folder) is one plugin, not a duplicate.
    for (const Candidate& other : candidates)
      if (other.file.path == file->path) return;
    candidates.push_back({*std::move(file), requested});
  };
  const auto add_folder = [&](const fs::path& folder, bool requested) {
    const auto files = plugin_files_in(folder);
    if (!files) {
      rejected_.push_back({folder.string(), files.error(), requested});
      return;
    }
    for (const fs::path& file : *files) add_file(file, false);
  };
  for (const fs::path& file : search.files) add_file(file, true);
  for (const fs::path& folder : search.folders) add_folder(folder, true);
  if (search.built_in) {
    const fs::path folder = built_in_plugin_folder();
    std::error_code failed;
    // A program without a plugin folder is not broken: its plugins may all come from the command line.
    if (!folder.empty() && fs::exists(folder, failed)) add_folder(folder, false);
  }
  return candidates;
}

void PluginRegistry::keep_locked(const PluginSearch& search, std::vector<Candidate>& candidates,
                                 std::vector<LockedPlugin>& locked) {
  auto lock = read_lock(search.lock);
  if (!lock) {
    rejected_.push_back({search.lock.string(), lock.error(), true});
    candidates.clear();
    return;
  }
  locked = *std::move(lock);
  std::string missing;
  for (const LockedPlugin& row : locked)
    if (std::none_of(candidates.begin(), candidates.end(),
                     [&](const Candidate& c) { return c.file.sha256 == row.sha256; }))
      missing += (missing.empty() ? "" : ", ") + row.id + " " + row.version + " (" + row.sha256 + ")";
  std::erase_if(candidates, [&](const Candidate& c) {
    const bool listed =
        std::any_of(locked.begin(), locked.end(), [&](const LockedPlugin& row) { return row.sha256 == c.file.sha256; });
    if (!listed)
      rejected_.push_back({c.file.path.string(),
                           {Cause::plugin, "PLUGIN_NOT_LOCKED",
                            "plugin file " + c.file.path.string() + " has the SHA-256 " + c.file.sha256 +
                                ", which is not in " + search.lock.string(),
                            "Leave the file out, or, if you trust it, write the lock anew: vitrine plugin lock --out " +
                                search.lock.string(),
                            "plugin"},
                           c.requested});
    return !listed;
  });
  if (!missing.empty())
    rejected_.push_back(
        {search.lock.string(),
         {Cause::plugin, "PLUGIN_LOCK_MISSING",
          search.lock.string() + " lists plugins of which no file was found: " + missing,
          "Bring the files back, name their folder with --plugin-dir, or write the lock anew", "plugin"},
         true});
}

PluginRegistry PluginRegistry::load(const PluginSearch& search) {
  PluginRegistry registry;
  std::vector<Candidate> candidates = registry.find(search);
  std::vector<LockedPlugin> locked;
  if (!search.lock.empty()) registry.keep_locked(search, candidates, locked);
  std::vector<PluginFile> files;
  for (const Candidate& candidate : candidates) files.push_back(candidate.file);
  const auto refusals = rehearse(files, search.rehearsal_seconds);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (refusals[i])
      registry.rejected_.push_back({files[i].path.string(), *refusals[i], candidates[i].requested});
    else
      registry.add(candidates[i], locked);
  }
  sort_by_id(registry.plugins_);
  sort_by_id(registry.garments_);
  sort_by_id(registry.necklines_);
  return registry;
}

void PluginRegistry::add(const Candidate& candidate, const std::vector<LockedPlugin>& locked) {
  const std::string path = candidate.file.path.string();
  const auto reject = [&](const Error& error) { rejected_.push_back({path, error, candidate.requested}); };
  const auto library = load_library(candidate.file);
  if (!library) return reject(library.error());
  auto plugin = adopt(*library, path);
  if (!plugin) return reject(plugin.error());
  plugin->identity.sha256 = candidate.file.sha256;
  for (const LockedPlugin& row : locked)
    if (row.sha256 == candidate.file.sha256 &&
        (row.id != plugin->identity.id || row.version != plugin->identity.version))
      return reject({Cause::plugin, "PLUGIN_NOT_LOCKED",
                     "plugin file " + path + " is " + plugin->identity.id + " " + plugin->identity.version +
                         ", its line in the lock says " + row.id + " " + row.version,
                     "Write the lock anew with vitrine plugin lock --out FILE", "plugin"});
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
