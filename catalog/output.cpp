// SPDX-License-Identifier: GPL-3.0-or-later
#include "output.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

namespace vitrine {
namespace {

namespace fs = std::filesystem;

constexpr const char* marker = ".vitrine-catalog";  // says: folders in here are ours to replace

Error unwritable_folder(const char* code, const std::string& message, const std::string& remedy) {
  return Error{Cause::unwritable, code, message, remedy, "catalog"};
}

}  // namespace

OutputFolder::~OutputFolder() {
  if (lock_ >= 0) ::close(lock_);
}

std::optional<Error> OutputFolder::open(const std::string& path, const std::vector<CatalogItem>& items) {
  root_ = path;
  std::error_code failed;
  fs::create_directories(root_, failed);
  if (!fs::is_directory(root_))
    return unwritable_folder("OUT_DIR", path + ": the folder cannot be made" + (failed ? ": " + failed.message() : ""),
                             "Choose a folder that you may write to.");
  if (!fs::exists(root_ / marker))
    for (const CatalogItem& item : items)
      if (fs::exists(fs::symlink_status(root_ / item.sku)))
        return unwritable_folder("OUT_DIR_FOREIGN",
                                 (root_ / item.sku).string() + ": exists and is not from an earlier catalogue run",
                                 "Choose an empty folder for the output.");
  lock_ = ::open((root_ / marker).c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (lock_ < 0)
    return unwritable_folder("OUT_DIR", path + ": " + std::generic_category().message(errno),
                             "Choose a folder that you may write to.");
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0)
    return unwritable_folder("OUT_DIR_BUSY", path + ": another catalogue run is writing here",
                             "Wait for it, or choose another folder.");
  for (const auto& entry : fs::directory_iterator(root_, failed))
    if (entry.path().filename().string().rfind(".partial-", 0) == 0) {
      std::error_code ignored;  // begin() reports what matters
      fs::remove_all(entry.path(), ignored);
    }
  return {};
}

std::optional<Error> OutputFolder::begin(const CatalogItem& item) {
  std::error_code failed;
  fs::remove_all(partial(item), failed);
  if (!failed) fs::create_directory(partial(item), failed);
  if (!failed) return {};
  return unwritable_folder("OUT_DIR", partial(item).string() + ": " + failed.message(),
                           "Choose a folder that you may write to.");
}

std::string OutputFolder::publish(const CatalogItem& item) {
  std::error_code failed;
  const fs::path place = root_ / item.sku, old = root_ / (".partial-" + item.sku + "~old");
  if (fs::exists(fs::symlink_status(place, failed))) {
    fs::rename(place, old, failed);
    if (failed) return failed.message();
  }
  fs::rename(partial(item), place, failed);
  if (failed) return failed.message();
  std::error_code ignored;  // a leftover is cleared by the next run
  fs::remove_all(old, ignored);
  return "";
}

void OutputFolder::discard(const CatalogItem& item, bool published) {
  std::error_code ignored;
  fs::remove_all(partial(item), ignored);
  if (published) fs::remove_all(root_ / item.sku, ignored);
}

std::optional<Error> OutputFolder::write_report(const std::vector<ItemRecord>& records) {
  const fs::path temporary = root_ / ".partial-report.jsonl~";
  std::ofstream out(temporary, std::ios::binary);
  for (const ItemRecord& record : records) out << record.line << '\n';
  out.close();
  std::error_code failed;
  if (out) fs::rename(temporary, report(), failed);
  if (out && !failed) return {};
  std::error_code ignored;
  fs::remove(temporary, ignored);
  return unwritable_folder("REPORT", report().string() + ": the report cannot be written",
                           "Free some space, or choose another folder.");
}

}  // namespace vitrine
