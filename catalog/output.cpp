// SPDX-License-Identifier: GPL-3.0-or-later
#include "output.hpp"

#include <fcntl.h>
#include <stdio.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <tuple>

namespace vitrine {
namespace {

namespace fs = std::filesystem;

Error unwritable_folder(const char* code, const std::string& message, const std::string& remedy) {
  return Error{Cause::unwritable, code, message, remedy, "catalog"};
}

Error folder_error(const fs::path& path, int reason) {
  return unwritable_folder("OUT_DIR", path.string() + ": " + std::generic_category().message(reason),
                           "Choose a folder that you may write to.");
}

}  // namespace

FolderLock::~FolderLock() {
  if (fd_ >= 0) ::close(fd_);
}

bool FolderLock::take(const fs::path& file, bool shared) {
  fd_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
  // The workers of a run that was killed hold its lock until they are dead, too: that takes a moment.
  for (int attempt = 0; fd_ >= 0; ++attempt) {
    if (::flock(fd_, (shared ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0) return true;
    if (errno != EWOULDBLOCK || attempt == 200) break;
    ::usleep(10'000);
  }
  return false;
}

std::string OutputFolder::suffix_of(int shard, int shards) {
  return shards == 1 ? "" : "-" + std::to_string(shard) + "-of-" + std::to_string(shards);
}

std::optional<Error> OutputFolder::open(const std::string& path, const std::vector<const CatalogItem*>& items,
                                        int shard, int shards) {
  root_ = path;
  suffix_ = suffix_of(shard, shards);
  std::error_code failed;
  fs::create_directories(root_, failed);
  if (!fs::is_directory(root_))
    return unwritable_folder("OUT_DIR", path + ": the folder cannot be made" + (failed ? ": " + failed.message() : ""),
                             "Choose a folder that you may write to.");
  if (!fs::exists(state()))
    for (const CatalogItem* item : items)
      // Asked again, because another shard may just have begun and put its first item here.
      if (fs::exists(fs::symlink_status(root_ / item->sku)) && !fs::exists(state()))
        return unwritable_folder("OUT_DIR_FOREIGN",
                                 (root_ / item->sku).string() + ": exists and is not from an earlier catalogue run",
                                 "Choose an empty folder for the output.");
  if (::mkdir(state().c_str(), 0777) != 0 && errno != EEXIST) return folder_error(root_, errno);
  for (auto [lock, file, shared] :
       {std::tuple(&whole_, state() / "lock", shards > 1), std::tuple(&own_, state() / ("lock" + suffix_), false)}) {
    if (shards == 1 && lock == &own_) continue;
    if (lock->take(file, shared)) continue;
    if (errno != EWOULDBLOCK) return folder_error(path, errno);
    return Error{Cause::temporary, "OUT_DIR_BUSY", path + ": another catalogue run is writing here",
                 "Wait for it, or choose another folder.", "catalog"};
  }
  fs::remove_all(work(), failed);
  for (const fs::path& folder : {work(), reports(), root_ / "quarantine"}) {
    fs::create_directories(folder, failed);
    if (failed) return folder_error(folder, failed.value());
  }
  return {};
}

std::optional<Error> OutputFolder::begin(const CatalogItem& item) {
  std::error_code failed;
  fs::remove_all(partial(item), failed);
  if (!failed) fs::create_directory(partial(item), failed);
  if (!failed) return {};
  return folder_error(partial(item), failed.value());
}

std::string OutputFolder::put(const fs::path& made, const fs::path& place) {
  if (::rename(made.c_str(), place.c_str()) == 0) return "";  // there was none
  // Both change places in one step, so that a reader always finds one or the other.
  if (::renameat2(AT_FDCWD, made.c_str(), AT_FDCWD, place.c_str(), RENAME_EXCHANGE) == 0) return "";
  if (errno != EINVAL && errno != ENOSYS) return std::generic_category().message(errno);
  // A file system that cannot exchange: for a moment there is none.
  const fs::path old = made.parent_path() / (made.filename().string() + "~old");
  std::error_code failed;
  fs::remove_all(old, failed);
  if (!failed) fs::rename(place, old, failed);
  if (!failed) fs::rename(made, place, failed);
  std::error_code ignored;  // a leftover is cleared by the next run
  fs::remove_all(old, ignored);
  return failed ? failed.message() : "";
}

std::string OutputFolder::remove(const fs::path& place, const CatalogItem& item) {
  std::error_code failed;
  if (!fs::exists(fs::symlink_status(place, failed))) return "";
  // Out of sight first: a reader does not meet half of it.
  const fs::path aside = work() / (item.sku + "~removed");
  fs::remove_all(aside, failed);
  if (!failed) fs::rename(place, aside, failed);
  if (failed) return failed.message();
  std::error_code ignored;
  fs::remove_all(aside, ignored);
  return "";
}

std::string OutputFolder::publish(const CatalogItem& item, const ItemRecord& record) {
  const fs::path place = root_ / item.sku, quarantine = root_ / "quarantine" / item.sku;
  std::string why;
  if (record.status == ItemStatus::refused) {
    why = put(partial(item), quarantine);
  } else if (record.status == ItemStatus::partly) {
    const fs::path apart = work() / (item.sku + "~quarantine");
    std::error_code failed;
    fs::remove_all(apart, failed);
    fs::rename(partial(item) / "quarantine", apart, failed);
    why = failed ? failed.message() : put(apart, quarantine);
    std::error_code ignored;
    fs::remove_all(apart, ignored);
  } else {
    why = remove(quarantine, item);
  }
  if (why.empty() && record.has_models()) why = put(partial(item), place);
  if (!record.has_models()) {
    const std::string kept = remove(place, item);
    if (why.empty()) why = kept;
  }
  discard(item);
  return why;
}

void OutputFolder::discard(const CatalogItem& item) {
  std::error_code ignored;
  fs::remove_all(partial(item), ignored);
}

}  // namespace vitrine
