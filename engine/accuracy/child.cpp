// SPDX-License-Identifier: GPL-3.0-or-later
#include "child.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <exception>

namespace vitrine::accuracy {
namespace {

bool send_all(int to, const Bytes& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = ::write(to, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace

std::optional<Child> start(const std::function<Bytes()>& work) {
  int ends[2];
  if (::pipe(ends) != 0) return std::nullopt;
  std::fflush(nullptr);  // or both processes would write what is still in a buffer
  Child child;
  child.pid = ::fork();
  if (child.pid < 0) {
    ::close(ends[0]);
    ::close(ends[1]);
    return std::nullopt;
  }
  if (child.pid == 0) {
    ::close(ends[0]);
    int code = 1;
    try {
      code = send_all(ends[1], work()) ? 0 : 1;
    } catch (const std::exception&) {
      // Memory that does not suffice, for one: the parent sees that nothing whole came.
    }
    ::close(ends[1]);
    ::_exit(code);
  }
  ::close(ends[1]);
  child.pipe = ends[0];
  return child;
}

bool listen(Child& child) {
  std::uint8_t buffer[1 << 16];
  const ssize_t n = ::read(child.pipe, buffer, sizeof buffer);
  if (n < 0 && errno == EINTR) return false;
  if (n > 0) {
    child.sent.insert(child.sent.end(), buffer, buffer + n);
    return false;
  }
  ::close(child.pipe);
  child.pipe = -1;
  int status = 0;
  rusage used{};
  while (::wait4(child.pid, &status, 0, &used) < 0 && errno == EINTR) {
  }
  child.fine = n == 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  child.peak_mb = static_cast<double>(used.ru_maxrss) / 1024;
  return true;
}

void finish(Child& child) {
  while (!listen(child)) {
  }
}

}  // namespace vitrine::accuracy
