// SPDX-License-Identifier: GPL-3.0-or-later
#include "atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

namespace vitrine {

std::string read_whole(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) return {};
  std::string text(static_cast<std::size_t>(std::max<std::streamoff>(0, in.tellg())), '\0');
  in.seekg(0);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

std::optional<Error> write_atomically(const std::filesystem::path& file, std::string_view text, bool durable) {
  const std::filesystem::path temporary = file.parent_path() / ("." + file.filename().string() + ".partial");
  const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0644);
  int reason = fd < 0 ? errno : 0;
  for (std::size_t at = 0; reason == 0 && at < text.size();) {
    const ssize_t n = ::write(fd, text.data() + at, text.size() - at);
    if (n >= 0)
      at += static_cast<std::size_t>(n);
    else if (errno != EINTR)
      reason = errno;
  }
  if (reason == 0 && durable && ::fsync(fd) != 0) reason = errno;
  if (fd >= 0 && ::close(fd) != 0 && reason == 0) reason = errno;
  if (reason == 0 && ::rename(temporary.c_str(), file.c_str()) != 0) reason = errno;
  if (reason == 0) return {};
  ::unlink(temporary.c_str());
  return Error{Cause::unwritable, "REPORT", file.string() + ": " + std::generic_category().message(reason),
               "Free some space, or choose a folder that you may write to.", "catalog"};
}

}  // namespace vitrine
