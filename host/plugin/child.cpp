// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/host/child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <iostream>

namespace vitrine {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t max_record = 1u << 20;  // [byte]
constexpr std::uint32_t finish = UINT32_MAX;    // in place of a length: the function returned

void send_bytes(int fd, const void* from, std::size_t size) {
  const char* data = static_cast<const char*>(from);
  while (size > 0) {
    const ssize_t n = ::write(fd, data, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    data += n;
    size -= static_cast<std::size_t>(n);
  }
}

[[noreturn]] void be_child(int fd, pid_t parent, const ChildLimits& limits,
                           const std::function<void(const ChildReport&)>& work) {
  // A process group of its own, so that what it starts dies with it; and it dies with the parent.
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(70);
  for (const int number : {SIGINT, SIGTERM, SIGPIPE}) ::signal(number, SIG_DFL);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  if (limits.cpu_seconds > 0) {
    const rlimit cpu{limits.cpu_seconds, limits.cpu_seconds + 1};
    ::setrlimit(RLIMIT_CPU, &cpu);
  }
  // An exception that leaves `work` ends in std::terminate, and so in SIGABRT, which is what it is: a crash.
  [&]() noexcept { work(ChildReport(fd)); }();
  send_bytes(fd, &finish, sizeof finish);
  // Not exit(): the parent's destructors and atexit handlers are the parent's to run.
  ::_exit(0);
}

/// Takes whole records off the front of what has arrived; true once the child said that it is done.
bool take_records(std::string& received, const std::function<void(const std::string&)>& receive, bool& garbled) {
  for (;;) {
    std::uint32_t size = 0;
    if (received.size() < sizeof size) return false;
    std::memcpy(&size, received.data(), sizeof size);
    if (size == finish) return true;
    if (size > max_record) {
      garbled = true;
      return false;
    }
    if (received.size() < sizeof size + size) return false;
    const std::string record = received.substr(sizeof size, size);
    received.erase(0, sizeof size + size);
    receive(record);
  }
}

}  // namespace

std::string ChildEnd::text() const {
  switch (how) {
    case How::finished:
      return "it finished";
    case How::crashed:
      if (number == SIGXCPU) return "it used up its processor time";
      return "it crashed (signal " + std::to_string(number) + ", " + ::strsignal(number) + ")";
    case How::exited:
      return "it ended the process with exit code " + std::to_string(number);
    case How::timed_out:
      return "it hung and was ended";
    case How::not_started:
      break;
  }
  return "no child process could be started";
}

void ChildReport::send(const std::string& record) const {
  const auto size = static_cast<std::uint32_t>(std::min<std::size_t>(record.size(), max_record));
  send_bytes(fd_, &size, sizeof size);
  send_bytes(fd_, record.data(), size);
}

ChildEnd run_in_child(const ChildLimits& limits, const std::function<void(const ChildReport&)>& work,
                      const std::function<void(const std::string&)>& receive) {
  ChildEnd end;
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return end;
  // What is still in a buffer would otherwise be printed by both processes.
  std::cout.flush();
  std::fflush(nullptr);
  const pid_t parent = ::getpid(), pid = ::fork();
  if (pid < 0) {
    ::close(ends[0]);
    ::close(ends[1]);
    return end;
  }
  if (pid == 0) {
    ::close(ends[0]);
    be_child(ends[1], parent, limits, work);
  }
  ::setpgid(pid, pid);  // both sides, whoever comes first
  ::close(ends[1]);
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  const auto patience = std::chrono::milliseconds(static_cast<std::int64_t>(limits.silent_seconds * 1000));
  auto deadline = Clock::now() + patience;
  std::string received;
  bool finished = false, garbled = false, ended = false, timed_out = false;
  int status = 0;
  while (!ended) {
    // The pipe alone does not tell of the end: a process that the child started may hold it open.
    pollfd waiting{ends[0], POLLIN, 0};
    ::poll(&waiting, 1, 20);
    ended = ::waitpid(pid, &status, WNOHANG) == pid;
    char buffer[16384];
    for (ssize_t n; (n = ::read(ends[0], buffer, sizeof buffer)) > 0;) {
      received.append(buffer, static_cast<std::size_t>(n));
      finished = finished || take_records(received, receive, garbled);
      deadline = Clock::now() + patience;
    }
    if (ended) break;
    if (garbled || Clock::now() > deadline) {
      timed_out = true;
      break;
    }
    if ((waiting.revents & (POLLIN | POLLHUP)) == POLLHUP) ::usleep(200);  // closed, but not yet gone
  }
  ::kill(-pid, SIGKILL);  // it, and what it started and left behind
  ::kill(pid, SIGKILL);
  while (!ended && ::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  ::close(ends[0]);
  if (timed_out) {
    end.how = ChildEnd::How::timed_out;
  } else if (finished) {
    end.how = ChildEnd::How::finished;
  } else if (WIFSIGNALED(status)) {
    end.how = ChildEnd::How::crashed;
    end.number = WTERMSIG(status);
  } else {
    end.how = ChildEnd::How::exited;
    end.number = WEXITSTATUS(status);
  }
  return end;
}

}  // namespace vitrine
