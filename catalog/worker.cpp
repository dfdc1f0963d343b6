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
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "quarantine.hpp"

namespace vitrine {
namespace {

constexpr std::size_t max_report = 1u << 20;   // [byte] a report line is a few hundred
constexpr std::size_t max_message = 4u << 20;  // [byte] with the files' hashes

void send(int fd, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t n = ::write(fd, data, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    data += n;
    size -= static_cast<std::size_t>(n);
  }
}

/// Address space of this process [byte]: what was loaded before the item began.
std::uint64_t address_space() {
  std::ifstream statm("/proc/self/statm");
  std::uint64_t pages = 0;
  statm >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void set_limits(const CatalogOptions& options) {
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  if (options.item_memory > 0) {
    const std::uint64_t most = address_space() + options.item_memory;
    const rlimit memory{most, most};
    ::setrlimit(RLIMIT_AS, &memory);
  }
  if (options.item_cpu_seconds > 0) {
    // SIGXCPU at the limit, SIGKILL a little later for what does not listen.
    const auto seconds = static_cast<rlim_t>(options.item_cpu_seconds);
    const rlimit cpu{seconds, seconds + 2};
    ::setrlimit(RLIMIT_CPU, &cpu);
  }
}

ItemOutcome convert_safely(const CatalogItem& item, const std::string& folder, const ItemFunction& convert) {
  try {
    return convert(item, folder);
  } catch (const std::bad_alloc&) {
    return {70, R"({"code":"OUT_OF_MEMORY","message":"the conversion needed more memory than it may have"})", false,
            ""};
  } catch (const std::exception& e) {
    const nlohmann::json why{{"code", "EXCEPTION"}, {"message", e.what()}};
    return {70, why.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)};
  } catch (...) {
    return {70, R"({"code":"EXCEPTION","message":"the conversion threw something unknown"})"};
  }
}

Fingerprints files_in(const std::filesystem::path& folder) {
  Fingerprints files;
  std::error_code failed;
  for (auto at = std::filesystem::recursive_directory_iterator(folder, failed); !failed && at != decltype(at)();
       at.increment(failed))
    if (at->is_regular_file(failed) && !at->is_symlink(failed))
      files[at->path().lexically_relative(folder).string()] = own_fingerprint(at->path());
  return files;
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
  set_limits(options);
  ItemOutcome outcome = convert_safely(item, folder, convert);
  if (outcome.report_json_line.size() > max_report) outcome.report_json_line.clear();
  if (auto error = add_reason(item, outcome, folder))
    outcome = {73, nlohmann::json{{"code", error->code}, {"message", error->message}}.dump()};
  const std::string message = nlohmann::json{{"exit_code", outcome.exit_code},
                                             {"partly", outcome.partly},
                                             {"report", outcome.report_json_line},
                                             {"stage_ms", outcome.stage_ms_json},
                                             {"files", to_json(files_in(folder))}}
                                  .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) +
                              "\n";
  send(fd, message.data(), message.size());
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
  worker.start_ = Clock::now();
  worker.deadline_ = worker.start_ + std::chrono::milliseconds(static_cast<std::int64_t>(options.item_seconds * 1000));
  return worker;
}

Worker::Worker(Worker&& other) noexcept {
  *this = std::move(other);
}

Worker& Worker::operator=(Worker&& other) noexcept {
  std::swap(pid_, other.pid_);
  std::swap(pipe_, other.pipe_);
  std::swap(status_, other.status_);
  std::swap(start_, other.start_);
  std::swap(deadline_, other.deadline_);
  std::swap(end_, other.end_);
  std::swap(usage_, other.usage_);
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
      if (received_.size() <= max_message) received_.append(buffer, static_cast<std::size_t>(n));
      continue;
    }
    ::close(pipe_);
    pipe_ = -1;
  }
}

bool Worker::poll() {
  drain();
  if (pid_ < 0) return true;
  const pid_t ended = ::wait4(pid_, &status_, WNOHANG, &usage_);
  if (ended != pid_) return false;
  end_ = Clock::now();
  drain();                 // what it sent between the two calls
  ::kill(-pid_, SIGKILL);  // what it started and left behind
  pid_ = -1;
  return true;
}

void Worker::kill() {
  if (pid_ < 0) return;
  ::kill(-pid_, SIGKILL);
  ::kill(pid_, SIGKILL);
  while (::wait4(pid_, &status_, 0, &usage_) < 0 && errno == EINTR) {
  }
  end_ = Clock::now();
  pid_ = -1;
}

WorkerEnd Worker::end() const {
  WorkerEnd end;
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  end.cpu_seconds = seconds(usage_.ru_utime) + seconds(usage_.ru_stime);
  end.wall_seconds = std::chrono::duration<double>(end_ - start_).count();
  end.peak_kilobytes = usage_.ru_maxrss;
  if (WIFSIGNALED(status_)) end.signal = WTERMSIG(status_);
  // A message that was cut short has no line break.
  if (end.signal != 0 || received_.empty() || received_.back() != '\n') return end;
  const auto message = nlohmann::json::parse(received_, nullptr, false);
  if (!message.is_object() || !from_json(message.value("files", nlohmann::json()), true, end.files)) return end;
  end.outcome = ItemOutcome{message.value("exit_code", 70), message.value("report", std::string()),
                            message.value("partly", false), message.value("stage_ms", std::string())};
  return end;
}

}  // namespace vitrine
