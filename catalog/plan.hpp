// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

#include "journal.hpp"
#include "vitrine/run_catalog.hpp"

namespace vitrine {

/// Whether an item has to be made, and the entry that will remember it.
struct Decision {
  bool runs = true;
  std::string why;
  JournalEntry entry;      ///< key, parts, inputs, attempts; and the known record and outputs when it does not run
  bool refreshed = false;  ///< does not run, but what is known of its files' stamps is out of date
};

class Planner {
 public:
  Planner(const CatalogOptions& options, const std::filesystem::path& root, const Journal& journal);
  Decision decide(const CatalogItem& item) const;
  /// Whether the photos are still what they were when the decision was taken.
  static bool same_inputs(const CatalogItem& item, const Fingerprints& before);

 private:
  std::string changed_output(Decision& decision, const JournalEntry& known) const;
  std::string reason_to_run(const CatalogItem& item, Decision& decision) const;

  const CatalogOptions& options_;
  const std::filesystem::path& root_;
  const Journal& journal_;
  std::string engine_, plugins_;  ///< hashes
};

/// Hash of everything that decides the shard reports that belong together: all rows, settings, engine, plugins.
std::string catalogue_id(const std::vector<CatalogItem>& items, const RunIdentity& identity);

/// USAGE errors of items and options; empty when run_catalog() can begin.
std::optional<Error> check_arguments(const std::vector<CatalogItem>& items, const CatalogOptions& options);

/// The items of the options' shard.
std::vector<const CatalogItem*> items_of_shard(const std::vector<CatalogItem>& items, const CatalogOptions& options);

}  // namespace vitrine
