// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/run_catalog.hpp"

#include <poll.h>

#include <algorithm>

#include "output.hpp"
#include "plan.hpp"
#include "progress.hpp"
#include "report.hpp"
#include "report_files.hpp"
#include "stop_signals.hpp"
#include "worker.hpp"

namespace vitrine {
namespace {

constexpr double seconds_between_flushes = 30;

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
  Run(const std::vector<const CatalogItem*>& items, const CatalogOptions& options, const ItemFunction& convert,
      OutputFolder& folder, Journal& journal)
      : items_(items),
        options_(options),
        convert_(convert),
        folder_(folder),
        journal_(journal),
        planner_(options, folder.root(), journal),
        decisions_(items.size()),
        records_(items.size()),
        progress_(options.progress, items.size()) {}

  std::optional<Error> all() {
    std::optional<Error> error;
    while (!signals_.asked() && !error && (next_ < items_.size() || !workers_.empty())) {
      if (next_ < items_.size() && workers_.size() < static_cast<std::size_t>(options_.jobs)) {
        error = start_next();
        progress_.tick();
        if (!error && !full_) continue;
      }
      if (!error && !workers_.empty()) wait(workers_, signals_.waiting_mask());
      collect();
      full_ = false;
      progress_.tick();
      journal_.sync(seconds_between_flushes);
    }
    interrupted_ = signals_.asked() && (next_ < items_.size() || !workers_.empty());
    for (Worker& worker : workers_) {
      worker.kill();
      folder_.discard(*items_[worker.index]);
    }
    workers_.clear();
    journal_.sync(0);
    return error;
  }

  CatalogSummary summary() const {
    CatalogSummary s;
    for (const ItemRecord& record : records_) count(s, record.status);
    s.unchanged = unchanged_;
    s.interrupted = interrupted_;
    s.report = (folder_.reports() / "report.jsonl").string();
    s.exit_code = interrupted_ ? 75 : exit_code_of(s, options_.fail_share);
    return s;
  }

  ReportLines lines() {
    ReportLines lines;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      if (records_[i].line.empty()) records_[i] = not_run(*items_[i]);
      lines[items_[i]->sku] = {records_[i].line, records_[i].timing};
    }
    return lines;
  }

 private:
  std::optional<Error> start_next() {
    const CatalogItem& item = *items_[next_];
    Decision& decision = decisions_[next_];
    if (decision.entry.key.empty()) {
      decision = planner_.decide(item);
      if (options_.why) progress_.say(item.sku + ": " + (decision.runs ? "made: " : "not made: ") + decision.why);
    }
    if (!decision.runs) {
      records_[next_] = decision.entry.record;
      ++unchanged_;
      progress_.unchanged(item, records_[next_]);
      if (decision.refreshed) journal_.add(item.sku, std::move(decision.entry));
      decision = {};
      ++next_;
      return {};
    }
    if (options_.prepare)
      if (std::optional<Error> error = options_.prepare(item)) return error;
    if (std::optional<Error> error = folder_.begin(item)) return error;
    std::optional<Worker> worker = Worker::start(item, folder_.partial(item).string(), options_, convert_);
    if (!worker) {
      folder_.discard(item);
      // With others still at work there will be room when they end.
      full_ = !workers_.empty();
      if (full_) return {};
      return Error{Cause::temporary, "FORK", "no process can be started for item " + item.sku,
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
    const CatalogItem& item = *items_[worker.index];
    Decision decision = std::move(decisions_[worker.index]);
    decisions_[worker.index] = {};
    const WorkerEnd end = worker.end();
    ItemRecord record = record_of(item, end, worker.timed_out, options_);
    if (const std::string why = folder_.publish(item, record); !why.empty()) {
      const std::string timing = record.timing;
      record = unwritable(item, why);
      record.timing = timing;
    }
    JournalEntry entry = std::move(decision.entry);
    entry.record = record;
    entry.outputs.clear();
    if (record.has_models() || record.has_quarantine())
      for (const auto& [file, print] : end.files) entry.outputs[place_of(item.sku, record.status, file)] = print;
    // Photos that changed meanwhile: nobody knows which of both were seen. The next run makes the item again.
    if (!Planner::same_inputs(item, entry.inputs)) entry.key = "-";
    journal_.add(item.sku, std::move(entry));
    progress_.ended(item, record);
    records_[worker.index] = std::move(record);
  }

  const std::vector<const CatalogItem*>& items_;
  const CatalogOptions& options_;
  const ItemFunction& convert_;
  OutputFolder& folder_;
  Journal& journal_;
  Planner planner_;
  StopSignals signals_;  // held until the report is written
  std::vector<Decision> decisions_;
  std::vector<ItemRecord> records_;
  std::vector<Worker> workers_;
  std::size_t next_ = 0;
  int unchanged_ = 0;
  bool full_ = false;
  bool interrupted_ = false;
  Progress progress_;
};

}  // namespace

Result<CatalogSummary> run_catalog(const std::vector<CatalogItem>& items, const CatalogOptions& options,
                                   const ItemFunction& convert) {
  if (auto error = check_arguments(items, options)) return *error;
  const std::vector<const CatalogItem*> own = items_of_shard(items, options);
  OutputFolder folder;
  if (auto error = folder.open(options.out_dir, own, options.shard, options.shards)) return *error;
  Journal journal;
  if (auto error = journal.open(folder.journal(), folder.state(), true)) return *error;
  ReportScope scope;
  scope.shard = options.shard;
  scope.shards = options.shards;
  scope.is_shard = options.shards > 1;
  scope.items = items.size();
  scope.catalogue = catalogue_id(items, options.identity);
  // A shard that dies must not be represented by its last night's report.
  std::error_code gone;
  if (scope.is_shard) std::filesystem::remove(folder.reports() / "summary.json", gone);
  Run run(own, options, convert, folder, journal);
  if (auto error = run.all()) return *error;
  const ReportLines lines = run.lines();
  const CatalogSummary summary = run.summary();
  // An interrupted shard has no report to merge: it is to be run again.
  if (summary.interrupted && scope.is_shard) return summary;
  if (auto error = write_reports(folder.reports(), folder.root(), lines, scope)) return *error;
  return summary;
}

}  // namespace vitrine
