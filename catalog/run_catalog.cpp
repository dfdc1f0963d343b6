// SPDX-License-Identifier: GPL-3.0-or-later
#include <poll.h>
#include <signal.h>

#include <algorithm>
#include <set>

#include "output.hpp"
#include "progress.hpp"
#include "report.hpp"
#include "sku.hpp"
#include "vitrine/catalog.hpp"
#include "worker.hpp"

namespace vitrine {
namespace {

volatile sig_atomic_t stop_asked = 0;

/// Turns SIGINT and SIGTERM into a flag. They stay blocked except while the run waits in ppoll, so that none is lost
/// between the look at the flag and the wait.
class StopSignals {
 public:
  StopSignals() {
    stop_asked = 0;
    struct sigaction action = {};
    action.sa_handler = [](int) { stop_asked = 1; };
    sigemptyset(&action.sa_mask);
    sigset_t both;
    sigemptyset(&both);
    for (std::size_t i = 0; i < 2; ++i) {
      sigaddset(&both, numbers[i]);
      sigaction(numbers[i], nullptr, &before_[i]);
      // A parent that ignores SIGINT (nohup, a shell's background job) means it.
      if (before_[i].sa_handler != SIG_IGN) sigaction(numbers[i], &action, nullptr);
    }
    sigprocmask(SIG_BLOCK, &both, &mask_);
  }
  ~StopSignals() {
    // A signal that is still pending has to meet the flag, not the old handler.
    sigprocmask(SIG_SETMASK, &mask_, nullptr);
    for (std::size_t i = 0; i < 2; ++i) sigaction(numbers[i], &before_[i], nullptr);
  }
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  const sigset_t& waiting_mask() const { return mask_; }

 private:
  static constexpr int numbers[2] = {SIGINT, SIGTERM};
  struct sigaction before_[2] = {};
  sigset_t mask_ = {};
};

/// Sleeps until a worker has something to say, one is late, or a signal came.
void wait(const std::vector<Worker>& workers, const sigset_t& mask) {
  std::vector<pollfd> fds;
  // A worker that has closed its pipe is about to end; nothing else announces that.
  auto until = Worker::Clock::now() + std::chrono::milliseconds(250);
  for (const Worker& worker : workers) {
    if (worker.pipe() >= 0)
      fds.push_back({worker.pipe(), POLLIN, 0});
    else
      until = std::min(until, Worker::Clock::now() + std::chrono::milliseconds(2));
    until = std::min(until, worker.deadline());
  }
  const auto left = std::chrono::duration_cast<std::chrono::nanoseconds>(until - Worker::Clock::now()).count();
  const timespec timeout{0, static_cast<long>(std::clamp<long long>(left, 0, 250'000'000))};
  ppoll(fds.data(), fds.size(), &timeout, &mask);
}

class Run {
 public:
  Run(const std::vector<CatalogItem>& items, const CatalogOptions& options, const ItemFunction& convert,
      OutputFolder& folder)
      : items_(items),
        options_(options),
        convert_(convert),
        folder_(folder),
        records_(items.size()),
        progress_(options.progress, items.size()) {}

  std::optional<Error> all() {
    std::optional<Error> error;
    while (!stop_asked && !error && (next_ < items_.size() || !workers_.empty())) {
      if (next_ < items_.size() && workers_.size() < static_cast<std::size_t>(options_.jobs)) {
        error = start_next();
        if (!error && !full_) continue;
      }
      if (!error && !workers_.empty()) wait(workers_, signals_.waiting_mask());
      collect();
      full_ = false;
    }
    interrupted_ = stop_asked != 0 && (next_ < items_.size() || !workers_.empty());
    for (Worker& worker : workers_) {
      worker.kill();
      folder_.discard(items_[worker.index], false);
    }
    workers_.clear();
    return error;
  }

  CatalogSummary summary() const {
    CatalogSummary s;
    s.total = static_cast<int>(items_.size());
    s.interrupted = interrupted_;
    s.report = folder_.report().string();
    int shared = 0;
    for (const ItemRecord& record : records_) {
      switch (record.status) {
        case ItemStatus::ok:
          ++s.ok;
          break;
        case ItemStatus::refused:
          ++s.refused;
          shared = shared == 0 || shared == record.exit_code ? record.exit_code : 65;
          break;
        case ItemStatus::failed:
          ++s.failed;
          break;
        case ItemStatus::crashed:
          ++s.crashed;
          break;
        case ItemStatus::timeout:
          ++s.timed_out;
          break;
        case ItemStatus::not_run:
          ++s.not_run;
          break;
      }
    }
    s.exit_code = s.interrupted ? 75 : s.failed + s.crashed + s.timed_out > 0 ? 70 : shared;
    return s;
  }

  const std::vector<ItemRecord>& records() {
    for (std::size_t i = 0; i < items_.size(); ++i)
      if (records_[i].line.empty()) records_[i] = not_run(items_[i]);
    return records_;
  }

 private:
  std::optional<Error> start_next() {
    const CatalogItem& item = items_[next_];
    if (std::optional<Error> error = folder_.begin(item)) return error;
    std::optional<Worker> worker = Worker::start(item, folder_.partial(item).string(), options_, convert_);
    if (!worker) {
      folder_.discard(item, false);
      // With others still at work there will be room when they end.
      full_ = !workers_.empty();
      if (full_) return {};
      return Error{Cause::internal, "FORK", "no process can be started for item " + item.sku,
                   "Check the limits on processes, open files and memory (ulimit -a).", "catalog"};
    }
    worker->index = next_++;
    workers_.push_back(std::move(*worker));
    return {};
  }

  void collect() {
    for (std::size_t i = 0; i < workers_.size();) {
      Worker& worker = workers_[i];
      bool ended = worker.poll();
      if (!ended && worker.late()) {
        worker.timed_out = ended = true;
        worker.kill();
      }
      if (!ended) {
        ++i;
        continue;
      }
      finish(worker);
      workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }

  void finish(const Worker& worker) {
    const CatalogItem& item = items_[worker.index];
    ItemRecord record = record_of(item, worker.end(), worker.timed_out, options_.item_seconds);
    if (record.has_result())
      if (const std::string why = folder_.publish(item); !why.empty()) record = unwritable(item, why);
    if (!record.has_result()) folder_.discard(item, true);
    progress_.ended(item, record);
    records_[worker.index] = std::move(record);
  }

  const std::vector<CatalogItem>& items_;
  const CatalogOptions& options_;
  const ItemFunction& convert_;
  OutputFolder& folder_;
  StopSignals signals_;  // held until the report is written
  std::vector<ItemRecord> records_;
  std::vector<Worker> workers_;
  std::size_t next_ = 0;
  bool full_ = false;
  bool interrupted_ = false;
  Progress progress_;
};

}  // namespace

Result<CatalogSummary> run_catalog(const std::vector<CatalogItem>& items, const CatalogOptions& options,
                                   const ItemFunction& convert) {
  if (options.jobs < 1 || options.jobs > 256 || !(options.item_seconds > 0) || options.item_seconds > 1e6)
    return Error{Cause::usage, "JOBS", "jobs has to be 1 to 256, and the time limit of an item above 0",
                 "Give the number of processor cores as jobs.", "catalog"};
  std::set<std::string> names;
  for (const CatalogItem& item : items)
    if (!is_safe_sku(item.sku) || !names.insert(item.sku).second)
      return Error{Cause::usage, "SKU_UNSAFE", "\"" + item.sku + "\" is used twice or cannot be the name of a folder",
                   "Read the items with read_manifest, which checks this.", "catalog"};
  OutputFolder folder;
  if (std::optional<Error> error = folder.open(options.out_dir, items)) return *error;
  CatalogSummary summary;
  {
    Run run(items, options, convert, folder);
    if (std::optional<Error> error = run.all()) return *error;
    if (std::optional<Error> error = folder.write_report(run.records())) return *error;
    summary = run.summary();
  }
  return summary;
}

}  // namespace vitrine
