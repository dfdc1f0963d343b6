// SPDX-License-Identifier: GPL-3.0-or-later
#include "process_state.hpp"

#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cfenv>
#include <clocale>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <new>
#include <sstream>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

extern char** environ;

namespace vitrine::validation {
namespace {

namespace fs = std::filesystem;

int entries_of(const char* folder) {
  std::error_code failed;
  int count = 0;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) ++count;
  return count;
}

std::vector<std::string> open_files() {
  std::vector<std::string> files;
  // Numbers first: the folder that lists them is an open file itself, and is gone when its link is looked at.
  std::vector<fs::path> links;
  std::error_code failed;
  for (fs::directory_iterator entry("/proc/self/fd", failed), end; !failed && entry != end; entry.increment(failed))
    links.push_back(entry->path());
  for (const fs::path& link : links) {
    const fs::path target = fs::read_symlink(link, failed);
    if (!failed) files.push_back(link.filename().string() + " -> " + target.string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::uint64_t address_space() {
  std::ifstream in("/proc/self/statm");
  std::uint64_t pages = 0;
  in >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

int count_children() {
  std::ifstream in("/proc/self/task/" + std::to_string(::getpid()) + "/children");
  int count = 0;
  for (std::string word; in >> word;) ++count;
  return count;
}

template <class F>
std::uintptr_t address(F function) {
  return reinterpret_cast<std::uintptr_t>(function);
}

}  // namespace

ProcessState ProcessState::now() {
  ProcessState s;
  s.threads = entries_of("/proc/self/task");
  s.children = count_children();
  s.open_files = validation::open_files();
  for (char** e = environ; e != nullptr && *e != nullptr; ++e) s.environment.emplace_back(*e);
  std::sort(s.environment.begin(), s.environment.end());
  std::error_code failed;
  s.folder = fs::current_path(failed).string();
  if (const char* locale = std::setlocale(LC_ALL, nullptr)) s.locale = locale;
  s.mode_mask = ::umask(0);
  ::umask(static_cast<mode_t>(s.mode_mask));
  sigset_t mask;
  ::sigprocmask(SIG_BLOCK, nullptr, &mask);
  for (int number = 1; number < 65; ++number) {
    struct sigaction action {};
    // The C library keeps two numbers for itself.
    s.handlers.push_back(::sigaction(number, nullptr, &action) == 0 ? address(action.sa_handler) : 0);
    s.blocked.push_back(::sigismember(&mask, number) == 1);
  }
  s.handlers.push_back(address(std::get_terminate()));
  s.handlers.push_back(address(std::get_new_handler()));
  for (const auto which : {ITIMER_REAL, ITIMER_VIRTUAL, ITIMER_PROF}) {
    itimerval timer{};
    ::getitimer(which, &timer);
    s.timer = s.timer || timer.it_value.tv_sec != 0 || timer.it_value.tv_usec != 0;
  }
  s.rounding = std::fegetround();
#if defined(__x86_64__)
  s.sse_control = _mm_getcsr() & ~0x3fu;
  __asm__ volatile("fnstcw %0" : "=m"(s.x87_control));
#endif
  s.address_space = validation::address_space();
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  s.cpu_seconds = static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                  1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  return s;
}

std::vector<Mapping> mappings() {
  std::vector<Mapping> all;
  std::ifstream in("/proc/self/maps");
  for (std::string line; std::getline(in, line);) {
    Mapping mapping;
    std::istringstream words(line);
    char dash = 0;
    std::string rights, offset, device, inode;
    words >> std::hex >> mapping.begin >> dash >> mapping.end >> rights >> offset >> device >> inode;
    std::getline(words >> std::ws, mapping.file);
    mapping.writable = rights.size() > 1 && rights[1] == 'w';
    all.push_back(std::move(mapping));
  }
  return all;
}

OutputTrap::OutputTrap() : memory_(::memfd_create("printed", MFD_CLOEXEC)) {
  std::cout.flush();
  std::fflush(nullptr);
  if (memory_ < 0) return;
  ::dup2(memory_, STDOUT_FILENO);
  ::dup2(memory_, STDERR_FILENO);
}

OutputTrap::~OutputTrap() {
  if (memory_ >= 0) ::close(memory_);
}

std::string OutputTrap::printed() const {
  std::cout.flush();
  std::fflush(nullptr);
  char buffer[80];
  const ssize_t n = memory_ < 0 ? 0 : ::pread(memory_, buffer, sizeof buffer, 0);
  return {buffer, static_cast<std::size_t>(std::max<ssize_t>(n, 0))};
}

}  // namespace vitrine::validation
