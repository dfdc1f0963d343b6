// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "vitrine/export.hpp"

namespace vitrine {
namespace {

Error unwritable(const std::string& path, int reason) {
  return {Cause::unwritable, "CANNOT_WRITE", "Cannot write " + path + ": " + std::strerror(reason) + ".",
          "Check that the folder exists, may be written to and has room.", "export"};
}

/// Writes everything or says why not; a signal or a full pipe may split a write.
int write_all(int fd, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    if (n == 0) return EIO;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return 0;
}

}  // namespace

std::optional<Error> write_file(const std::string& path, std::span<const std::uint8_t> bytes) {
  const std::filesystem::path target(path);
  if (!target.has_filename()) return unwritable(path, EISDIR);
  // The process number keeps two workers apart, the counter what a crashed worker of the same number left behind.
  int fd = -1;
  std::string temporary;
  for (int attempt = 0; fd < 0 && attempt < 100; ++attempt) {
    temporary = (target.parent_path() / ("." + target.filename().string() + "." + std::to_string(::getpid()) + "." +
                                         std::to_string(attempt) + ".tmp"))
                    .string();
    fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd < 0 && errno != EEXIST) return unwritable(path, errno);
  }
  if (fd < 0) return unwritable(path, EEXIST);
  int reason = write_all(fd, bytes);
  // Network and quota file systems report a full disk only here.
  if (::close(fd) != 0 && reason == 0) reason = errno;
  if (reason == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) reason = errno;
  if (reason == 0) return std::nullopt;
  ::unlink(temporary.c_str());
  return unwritable(path, reason);
}

std::optional<Error> write_file(const std::string& path, const std::string& text) {
  return write_file(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

}  // namespace vitrine
