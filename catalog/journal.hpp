// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "fingerprint.hpp"
#include "report.hpp"

namespace vitrine {

/// What is remembered of an item: what it was made of, and what became of it.
struct JournalEntry {
  std::string key;                           ///< [hex] SHA-256 over parts and the inputs' content
  std::map<std::string, std::string> parts;  ///< "row", "settings", "engine", "plugins": hash of each
  Fingerprints inputs;                       ///< "front", "back", "front_mask", "back_mask"
  Fingerprints outputs;                      ///< regular files, by path in the output folder
  ItemRecord record;
  int attempts = 1;  ///< with this key, one after the other
};

/// The memory of a folder: JSON, a line for every item that ended, the last one counts. It is only ever appended to, by
/// one write per line, so that a process that dies at any point leaves at most one torn line at the end, which the next
/// one cuts off. It is written after the item's files are in place: what it knows is there, and an item that it does
/// not know is made again, with the same bytes.
///
/// Losing power is another matter: files whose lines are on the disk may not be there yet. So every half minute, and at
/// the end, the file system is flushed and a line says so; files of items after the last such line are read again, and
/// compared with their hashes, by the next run.
class Journal {
 public:
  ~Journal();
  Journal() = default;
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Reads the journal, and what others of the folder know about items that it does not. Cuts off a torn line, and
  /// writes the file anew (by rename) when most of its lines are outdated. Without `writable` nothing is touched.
  std::optional<Error> open(const std::filesystem::path& file, const std::filesystem::path& folder, bool writable);
  /// The item's entry, or null.
  const JournalEntry* find(const std::string& sku) const;
  /// Remembers and appends. False when the line cannot be written; what was written of it is taken back.
  bool add(const std::string& sku, JournalEntry entry);
  /// Flushes the file system and notes it, when `after` seconds went by since the last time and there is something new.
  void sync(double after);

 private:
  struct Read {
    std::map<std::string, JournalEntry> entries;
    std::uintmax_t good = 0, lines = 0;  ///< bytes of whole lines
  };
  static Read read(const std::filesystem::path& file);
  bool append(const std::string& line);
  std::optional<Error> compact(const std::filesystem::path& file);

  std::map<std::string, JournalEntry> entries_;
  int fd_ = -1;
  bool unsynced_ = false;
  double last_sync_ = 0;
};

}  // namespace vitrine
