// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vitrine/host/adopt.hpp"
#include "vitrine/host/lock.hpp"
#include "vitrine/host/search.hpp"

namespace vitrine {

/// Where plugins are looked for, in this order. Nothing else is searched: not the current directory, no environment
/// variable, and a name without a folder is refused.
struct PluginSearch {
  std::vector<std::filesystem::path> files;    ///< --plugin FILE
  std::vector<std::filesystem::path> folders;  ///< --plugin-dir DIR
  bool built_in = true;                        ///< then the folder that belongs to the program, if there is one
  std::filesystem::path lock = {};             ///< only what this plugins.lock lists; empty = everything
  double rehearsal_seconds = 10;               ///< [s] the longest that loading one file may take
};

/// <prefix>/lib/vitrine-1/plugins, the prefix being the folder above the one that holds the running program; the same
/// in a build tree and an installation. Empty when the program's own path cannot be read.
std::filesystem::path built_in_plugin_folder();

/// A file or folder that was refused, and why.
struct RejectedPlugin {
  std::string file;
  Error error;             ///< (69)
  bool requested = false;  ///< the user named it, by --plugin or --plugin-dir
};

/// Everything that could be adopted. Files are loaded and adopted in a child process first, so that one which crashes,
/// hangs or ends the process at load is refused like any other. Libraries stay loaded until the process ends; the
/// registry holds copies only.
class PluginRegistry {
 public:
  /// Finds, trusts, loads and adopts. One bad file does not keep the others from loading: it is in rejected().
  static PluginRegistry load(const PluginSearch& search);

  const GarmentTemplate* find_garment(std::string_view id) const;                ///< null when no plugin supplies it
  const NecklineTemplate* find_neckline(std::string_view id) const;              ///< null when no plugin supplies it
  const std::vector<GarmentTemplate>& garments() const { return garments_; }     ///< by id
  const std::vector<NecklineTemplate>& necklines() const { return necklines_; }  ///< by id
  const std::vector<PluginIdentity>& plugins() const { return plugins_; }        ///< by plugin id
  const std::vector<RejectedPlugin>& rejected() const { return rejected_; }      ///< in the order of discovery

  /// What should stop the program before it starts to work: a file or folder that the user named was refused, or two
  /// plugins supply the same id (code PLUGIN_DUPLICATE_ID, the message names both paths), or the lock could not be read
  /// or names plugins that are not there (PLUGIN_LOCK_MISSING).
  std::optional<Error> problem() const;

 private:
  struct Candidate {
    PluginFile file;
    bool requested = false;
  };
  std::vector<Candidate> find(const PluginSearch& search);
  void keep_locked(const PluginSearch& search, std::vector<Candidate>& candidates, std::vector<LockedPlugin>& locked);
  void add(const Candidate& candidate, const std::vector<LockedPlugin>& locked);
  std::optional<Error> duplicate(const AdoptedPlugin& plugin) const;
  std::string file_of(const std::string& plugin_id) const;

  std::vector<PluginIdentity> plugins_;
  std::vector<GarmentTemplate> garments_;
  std::vector<NecklineTemplate> necklines_;
  std::vector<RejectedPlugin> rejected_;
};

}  // namespace vitrine
