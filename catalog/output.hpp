// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "report.hpp"

namespace vitrine {

/// Locked by flock() until it is closed or the process ends, however it ends.
class FolderLock {
 public:
  FolderLock() = default;
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();
  /// False with errno EWOULDBLOCK when somebody else holds it.
  bool take(const std::filesystem::path& file, bool shared);

 private:
  int fd_ = -1;
};

/// The folder a catalogue is written to: locked against a second run, results put in place by rename. Shards share it.
class OutputFolder {
 public:
  /// Makes and locks the folder, and clears away what an earlier run left unfinished. The whole folder is locked
  /// against everybody (`shards` = 1), or one shard of it against itself.
  std::optional<Error> open(const std::string& path, const std::vector<const CatalogItem*>& items, int shard,
                            int shards);

  /// An empty folder in which an item is worked on.
  std::optional<Error> begin(const CatalogItem& item);
  std::filesystem::path partial(const CatalogItem& item) const { return work() / item.sku; }
  /// Puts what the item made in place of what an earlier run left, and takes away what it did not make again: its
  /// folder out/<sku> and its folder out/quarantine/<sku>. Returns the reason where that fails.
  std::string publish(const CatalogItem& item, const ItemRecord& record);
  /// Removes the item's unfinished folder.
  void discard(const CatalogItem& item);

  const std::filesystem::path& root() const { return root_; }
  std::filesystem::path state() const { return root_ / state_folder; }
  std::filesystem::path work() const { return state() / ("work" + suffix_); }
  std::filesystem::path journal() const { return state() / ("journal" + suffix_ + ".jsonl"); }
  /// Where this run's reports go: the folder itself, or one of the shard's own.
  std::filesystem::path reports() const { return suffix_.empty() ? root_ : root_ / "shards" / suffix_.substr(1); }

  static constexpr const char* state_folder = ".vitrine-catalog";  ///< says too: folders beside it are ours to replace
  static std::string suffix_of(int shard, int shards);             ///< "" or "-3-of-8"

 private:
  std::string put(const std::filesystem::path& made, const std::filesystem::path& place);
  std::string remove(const std::filesystem::path& place, const CatalogItem& item);

  std::filesystem::path root_;
  std::string suffix_;
  FolderLock whole_, own_;
};

}  // namespace vitrine
