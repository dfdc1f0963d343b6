// SPDX-License-Identifier: GPL-3.0-or-later
#include "worker.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>

namespace vitrine {
namespace {

constexpr std::size_t max_report = 1u << 20;  // [byte] a report line is a few hundred

void send(int fd, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t n = ::write(fd, data, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    data += n;
    size -= static_cast<std::size_t>(n);
  }
}

[[noreturn]] void run(const CatalogItem& item, const std::string& folder, const CatalogOptions& options,
                      const ItemFunction& convert, int fd, pid_t parent) {
  // A process group of its own, so that its own children die with it; and it dies with the parent.
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(70);
  for (const int number : {SIGINT, SIGTERM, SIGPIPE}) ::signal(number, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  if (options.item_memory > 0) {
    const rlimit memory{options.item_memory, options.item_memory};
    ::setrlimit(RLIMIT_AS, &memory);
  }
  ItemOutcome outcome;
  try {
    outcome = convert(item, folder);
  } catch (const std::bad_alloc&) {
    outcome = {70, R"({"code":"OUT_OF_MEMORY","message":"the conversion needed more memory than it may have"})"};
  } catch (const std::exception& e) {
    const nlohmann::json why{{"code", "EXCEPTION"}, {"message", e.what()}};
    outcome = {70, why.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)};
  } catch (...) {
    outcome = {70, R"({"code":"EXCEPTION","message":"the conversion threw something unknown"})"};
  }
  const auto code = static_cast<std::int32_t>(outcome.exit_code);
  const auto size = static_cast<std::uint32_t>(std::min(outcome.report_json_line.size(), max_report + 1));
  send(fd, reinterpret_cast<const char*>(&code), sizeof code);
  send(fd, reinterpret_cast<const char*>(&size), sizeof size);
  send(fd, outcome.report_json_line.data(), size);
  std::cout.flush();
  std::fflush(nullptr);
  // Not exit(): the parent's destructors and atexit handlers are the parent's to run.
  ::_exit(0);
}

}  // namespace

std::optional<Worker> Worker::start(const CatalogItem& item, const std::string& folder, const CatalogOptions& options,
                                    const ItemFunction& convert) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return {};
  // What is still in a buffer would otherwise be printed by both processes.
  std::cout.flush();
  std::fflush(nullptr);
  const pid_t parent = ::getpid(), pid = ::fork();
  if (pid < 0) {
    ::close(ends[0]);
    ::close(ends[1]);
    return {};
  }
  if (pid == 0) {
    ::close(ends[0]);
    run(item, folder, options, convert, ends[1], parent);
  }
  ::setpgid(pid, pid);  // both sides, whoever comes first
  ::close(ends[1]);
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  Worker worker;
  worker.pid_ = pid;
  worker.pipe_ = ends[0];
  worker.deadline_ = Clock::now() + std::chrono::milliseconds(static_cast<std::int64_t>(options.item_seconds * 1000));
  return worker;
}

Worker::Worker(Worker&& other) noexcept {
  *this = std::move(other);
}

Worker& Worker::operator=(Worker&& other) noexcept {
  std::swap(pid_, other.pid_);
  std::swap(pipe_, other.pipe_);
  std::swap(status_, other.status_);
  std::swap(deadline_, other.deadline_);
  std::swap(received_, other.received_);
  std::swap(index, other.index);
  std::swap(timed_out, other.timed_out);
  return *this;
}

Worker::~Worker() {
  kill();
  if (pipe_ >= 0) ::close(pipe_);
}

void Worker::drain() {
  char buffer[16384];
  while (pipe_ >= 0) {
    const ssize_t n = ::read(pipe_, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return;
    if (n > 0) {
      // More than a report can be is not kept; end() then finds no outcome.
      if (received_.size() <= max_report + 64) received_.append(buffer, static_cast<std::size_t>(n));
      continue;
    }
    ::close(pipe_);
    pipe_ = -1;
  }
}

bool Worker::poll() {
  drain();
  if (pid_ < 0) return true;
  const pid_t ended = ::waitpid(pid_, &status_, WNOHANG);
  if (ended != pid_) return false;
  drain();                 // what it sent between the two calls
  ::kill(-pid_, SIGKILL);  // what it started and left behind
  pid_ = -1;
  return true;
}

void Worker::kill() {
  if (pid_ < 0) return;
  ::kill(-pid_, SIGKILL);
  ::kill(pid_, SIGKILL);
  while (::waitpid(pid_, &status_, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
}

WorkerEnd Worker::end() const {
  WorkerEnd end;
  if (WIFSIGNALED(status_)) end.signal = WTERMSIG(status_);
  std::int32_t code = 0;
  std::uint32_t size = 0;
  if (end.signal != 0 || received_.size() < sizeof code + sizeof size) return end;
  std::memcpy(&code, received_.data(), sizeof code);
  std::memcpy(&size, received_.data() + sizeof code, sizeof size);
  if (size > max_report || received_.size() != sizeof code + sizeof size + size) return end;
  end.outcome = ItemOutcome{code, received_.substr(sizeof code + sizeof size)};
  return end;
}

}  // namespace vitrine
