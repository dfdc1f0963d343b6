// SPDX-License-Identifier: GPL-3.0-or-later
#include "journal.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <vector>

#include "atomic_file.hpp"

namespace vitrine {
namespace {

namespace fs = std::filesystem;

constexpr const char* synced_line = "{\"synced\":true}\n";

double monotonic_seconds() {
  timespec now;
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string line_of(const std::string& sku, const JournalEntry& e) {
  const nlohmann::json json{{"sku", sku},
                            {"key", e.key},
                            {"parts", e.parts},
                            {"inputs", to_json(e.inputs)},
                            {"outputs", to_json(e.outputs)},
                            {"status", name_of(e.record.status)},
                            {"exit_code", e.record.exit_code},
                            {"code", e.record.code},
                            {"line", e.record.line},
                            {"timing", e.record.timing},
                            {"attempts", e.attempts}};
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

bool entry_of(const nlohmann::json& json, bool trusted, std::string& sku, JournalEntry& e) {
  const auto text = [&](const char* key, std::string& to) {
    const auto found = json.find(key);
    if (found == json.end() || !found->is_string()) return false;
    to = found->get<std::string>();
    return true;
  };
  const auto number = [&](const char* key, int& to) {
    const auto found = json.find(key);
    if (found == json.end() || !found->is_number_integer()) return false;
    to = found->get<int>();
    return true;
  };
  std::string status;
  if (!text("sku", sku) || !text("key", e.key) || !text("status", status) || !text("code", e.record.code) ||
      !text("line", e.record.line) || !text("timing", e.record.timing) || !number("exit_code", e.record.exit_code) ||
      !number("attempts", e.attempts))
    return false;
  const auto known = status_named(status);
  if (!known || !json.contains("parts") || !json["parts"].is_object()) return false;
  e.record.status = *known;
  for (const auto& [name, value] : json["parts"].items()) {
    if (!value.is_string()) return false;
    e.parts[name] = value.get<std::string>();
  }
  return from_json(json.value("inputs", nlohmann::json()), true, e.inputs) &&
         from_json(json.value("outputs", nlohmann::json()), trusted, e.outputs);
}

}  // namespace

Journal::~Journal() {
  if (fd_ >= 0) ::close(fd_);
}

Journal::Read Journal::read(const fs::path& file) {
  Read result;
  const std::string text = read_whole(file);
  // What comes before the last flush is on the disk for sure.
  const std::size_t synced = text.rfind(synced_line);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;
    const std::string_view line(text.data() + begin, end - begin);
    const nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
    // A whole line that is no entry of ours (another version's, or damaged) is one that we do not know.
    if (json.is_object() && json.contains("sku")) {
      std::string sku;
      JournalEntry entry;
      const bool trusted = synced != std::string::npos && begin < synced;
      if (entry_of(json, trusted, sku, entry)) result.entries[sku] = std::move(entry);
    }
    ++result.lines;
    begin = result.good = end + 1;
  }
  return result;
}

std::optional<Error> Journal::open(const fs::path& file, const fs::path& folder, bool writable) {
  Read own = read(file);
  entries_ = std::move(own.entries);
  if (entries_.empty()) {
    // The first run with this number of shards: what earlier ones with another number know is still true.
    std::vector<std::pair<fs::file_time_type, fs::path>> others;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(folder, failed))
      if (entry.path().filename().string().rfind("journal", 0) == 0 && entry.path() != file)
        others.emplace_back(entry.last_write_time(failed), entry.path());
    std::sort(others.begin(), others.end());
    for (const auto& other : others)
      for (auto& [sku, entry] : read(other.second).entries) entries_[sku] = std::move(entry);
  }
  if (!writable) return {};
  const auto unwritable = [&](int reason) {
    return Error{Cause::unwritable, "JOURNAL", file.string() + ": " + std::generic_category().message(reason),
                 "Free some space, or choose a folder that you may write to.", "catalog"};
  };
  const bool outdated = own.lines > 2 * entries_.size() + 100;
  if (outdated)
    if (auto error = compact(file)) return error;
  fd_ = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (fd_ < 0) return unwritable(errno);
  struct stat s;
  if (!outdated && ::fstat(fd_, &s) == 0 && static_cast<std::uintmax_t>(s.st_size) > own.good)
    if (::ftruncate(fd_, static_cast<off_t>(own.good)) != 0) return unwritable(errno);
  last_sync_ = monotonic_seconds();
  return {};
}

const JournalEntry* Journal::find(const std::string& sku) const {
  const auto found = entries_.find(sku);
  return found == entries_.end() ? nullptr : &found->second;
}

bool Journal::add(const std::string& sku, JournalEntry entry) {
  const bool written = append(line_of(sku, entry));
  entries_[sku] = std::move(entry);
  unsynced_ = unsynced_ || written;
  return written;
}

bool Journal::append(const std::string& line) {
  struct stat before;
  if (fd_ < 0 || ::fstat(fd_, &before) != 0) return false;
  ssize_t n;
  do n = ::write(fd_, line.data(), line.size());
  while (n < 0 && errno == EINTR);
  if (n == static_cast<ssize_t>(line.size())) return true;
  // A full disk takes the beginning of a line; the next line would be glued to it. Where even that fails, nothing is
  // appended any more: a torn line may only be the last.
  if (n > 0 && ::ftruncate(fd_, before.st_size) != 0) {
    ::close(fd_);
    fd_ = -1;
  }
  return false;
}

void Journal::sync(double after) {
  if (fd_ < 0 || !unsynced_ || monotonic_seconds() - last_sync_ < after) return;
  last_sync_ = monotonic_seconds();
  if (::syncfs(fd_) == 0 && append(synced_line) && ::fdatasync(fd_) == 0) unsynced_ = false;
}

std::optional<Error> Journal::compact(const fs::path& file) {
  std::string text;
  for (const auto& [sku, entry] : entries_) text += line_of(sku, entry);
  return write_atomically(file, text, true);
}

}  // namespace vitrine
