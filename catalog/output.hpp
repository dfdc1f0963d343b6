// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "report.hpp"

namespace vitrine {

/// The folder a catalogue is written to: locked against a second run, results put in place by rename.
class OutputFolder {
 public:
  /// Makes and locks the folder, and clears away what an earlier run left unfinished.
  std::optional<Error> open(const std::string& path, const std::vector<CatalogItem>& items);
  OutputFolder() = default;
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder();

  /// An empty folder in which an item is worked on.
  std::optional<Error> begin(const CatalogItem& item);
  std::filesystem::path partial(const CatalogItem& item) const { return root_ / (".partial-" + item.sku); }
  /// Takes the item's folder in place of that of an earlier run. Returns the reason where that fails.
  std::string publish(const CatalogItem& item);
  /// Removes the item's unfinished folder and, with `published`, the one of an earlier run.
  void discard(const CatalogItem& item, bool published);
  /// Writes report.jsonl in one step.
  std::optional<Error> write_report(const std::vector<ItemRecord>& records);
  std::filesystem::path report() const { return root_ / "report.jsonl"; }

 private:
  std::filesystem::path root_;
  int lock_ = -1;
};

}  // namespace vitrine
