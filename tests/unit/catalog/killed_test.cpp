// SPDX-License-Identifier: GPL-3.0-or-later
// kill -9 at any moment, of the run or of one of its workers: the next run ends with what an undisturbed one leaves.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <random>

#include "catalog_scratch.hpp"

using ::testing::HasSubstr;
using namespace vitrine;
namespace fs = std::filesystem;

/// Shared with the processes that are forked.
struct AtWork {
  std::atomic<int> last{0};     ///< the process that began an item last
  std::atomic<int> started{0};  ///< items so far
};

namespace {

constexpr int count = 16;
constexpr std::size_t length = 20'000;  // [byte] so that a file is more than one write

std::string content_of(const std::string& sku, const std::string& night) {
  return std::string(length, sku.back()) + night + "end";
}

AtWork* shared_memory() {
  void* page = ::mmap(nullptr, sizeof(AtWork), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  return page == MAP_FAILED ? nullptr : new (page) AtWork;
}

long microseconds() {
  timespec t;
  ::clock_gettime(CLOCK_MONOTONIC, &t);
  return t.tv_sec * 1'000'000L + t.tv_nsec / 1000;
}

}  // namespace

class Killed : public CatalogScratch {
 protected:
  void SetUp() override {
    CatalogScratch::SetUp();
    std::vector<std::string> skus;
    for (int i = 0; i < count; ++i)
      skus.push_back(std::string(i % 5 == 3 ? "refuse-" : "item-") + static_cast<char>('a' + i));
    list = items(skus);
    options.jobs = 3;
    at_work = shared_memory();
    ASSERT_NE(at_work, nullptr);
  }
  ItemFunction converter(const std::string& night) const {
    return [this, night](const CatalogItem& item, const std::string& dir) {
      at_work->last = ::getpid();
      ++at_work->started;
      const std::string text = content_of(item.sku, night);
      std::ofstream out(fs::path(dir) / "model.txt", std::ios::binary);
      out.write(text.data(), static_cast<std::streamsize>(length / 2)).flush();
      out << text.substr(length / 2);
      out.close();
      if (item.sku[0] == 'r') return ItemOutcome{65, R"({"code":"BLURRED","message":"out of focus"})"};
      return ItemOutcome{0, "{}"};
    };
  }
  CatalogSummary night(const std::string& name) {
    options.identity.settings = [name](const CatalogItem&) { return name; };
    return run(list, converter(name));
  }
  /// Looks at the files as a shop's server would while the run goes on: each is whole, of this night or the last.
  void look_at(const CatalogItem& item) const {
    const std::string text = read(root / "out" / item.sku / "model.txt");
    if (text.empty()) return;
    EXPECT_TRUE(text == content_of(item.sku, "old") || text == content_of(item.sku, "new"))
        << item.sku << ": " << text.size() << " bytes";
    std::istringstream lines(read(root / "out/report.jsonl"));
    int whole = 0;
    for (std::string line; std::getline(lines, line); ++whole) EXPECT_TRUE(nlohmann::json::accept(line));
    EXPECT_TRUE(whole == 0 || whole == count) << whole;
  }
  std::vector<CatalogItem> list;
  AtWork* at_work = nullptr;
};

/// A process' state as the kernel tells it; empty when it has ended, which it may do while it is being read.
std::string stat_of(pid_t process) {
  std::string stat(512, '\0');
  const int file = ::open(("/proc/" + std::to_string(process) + "/stat").c_str(), O_RDONLY | O_CLOEXEC);
  const ssize_t size = file < 0 ? -1 : ::read(file, stat.data(), stat.size());
  if (file >= 0) ::close(file);
  stat.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return stat;
}

TEST_F(Killed, at_200_moments_the_next_run_leaves_the_same_bytes_as_one_that_was_never_disturbed) {
  const long begin = microseconds();
  night("new");
  const long usual = microseconds() - begin;
  const auto undisturbed = tree(root / "out");
  ASSERT_EQ(undisturbed.count("report.html"), 1u);

  std::mt19937 random(1);
  int runs_killed = 0, workers_killed = 0, unfinished = 0;
  for (int round = 0; round < 200; ++round) {
    SCOPED_TRACE(round);
    fs::remove_all(root / "out");
    if (round % 4 == 0) night("old");
    const bool kill_worker = round % 3 == 0;
    at_work->last = at_work->started = 0;
    const pid_t runner = ::fork();
    ASSERT_GE(runner, 0);
    if (runner == 0) {
      night("new");
      ::_exit(0);
    }
    // So many items into the run, and a little later: on a busy machine, times alone would fall after its end.
    const int items_in = std::uniform_int_distribution<int>(0, count)(random);
    const long later = std::uniform_int_distribution<long>(0, usual / 8)(random);
    const long too_late = microseconds() + 60'000'000;
    for (long until = 0; until == 0 || microseconds() < until;) {
      if (until == 0 && at_work->started >= items_in) until = microseconds() + later;
      ASSERT_LT(microseconds(), too_late) << "no item begins any more";
      ::usleep(200);
      look_at(list[random() % list.size()]);
    }
    if (kill_worker) {
      // A number may have been given to another process by now: only a child of the run is ours to kill.
      const pid_t victim = at_work->last;
      const std::string stat = victim > 0 ? stat_of(victim) : "";
      if (stat.find(") R " + std::to_string(runner) + " ") != std::string::npos ||
          stat.find(") S " + std::to_string(runner) + " ") != std::string::npos ||
          stat.find(") D " + std::to_string(runner) + " ") != std::string::npos)
        workers_killed += ::kill(victim, SIGKILL) == 0;
    } else {
      runs_killed += ::kill(runner, SIGKILL) == 0;
    }
    int status = 0;
    ASSERT_EQ(::waitpid(runner, &status, 0), runner);
    unfinished += !has("") || tree(root / "out") != undisturbed;
    const CatalogSummary s = night("new");
    ASSERT_EQ(s.total, count);
    const auto now = tree(root / "out");
    ASSERT_EQ(now.size(), undisturbed.size());
    for (const auto& [file, bytes] : undisturbed) {
      ASSERT_EQ(now.count(file), 1u) << file;
      ASSERT_TRUE(now.at(file) == bytes) << file;
    }
    ASSERT_EQ(static_cast<int>(report().size()), count) << "every item exactly once";
    ASSERT_TRUE(fs::is_empty(root / "out/.vitrine-catalog/work"));
    if (HasFailure()) break;
  }
  // Otherwise the moments were badly chosen.
  EXPECT_GT(runs_killed, 100);
  EXPECT_GT(workers_killed, 5);
  EXPECT_GT(unfinished, 40);
  RecordProperty("unfinished", unfinished);
}
