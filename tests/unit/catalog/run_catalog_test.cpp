// SPDX-License-Identifier: GPL-3.0-or-later

#include <gmock/gmock.h>
#include <signal.h>

#include <cstdlib>
#include <map>

#include "catalog_scratch.hpp"

using ::testing::HasSubstr;
using ::testing::StartsWith;
using namespace vitrine;
namespace fs = std::filesystem;

class RunCatalog : public CatalogScratch {
 protected:
  /// No file or folder of the run is left but results, report and marker.
  void expect_nothing_partial() const {
    for (const auto& entry : fs::recursive_directory_iterator(root / "out"))
      EXPECT_THAT(entry.path().filename().string(), ::testing::Not(HasSubstr("partial"))) << entry.path();
    EXPECT_TRUE(fs::is_empty(root / "out/.vitrine-catalog/work"));
  }
};

namespace {

ItemOutcome well(const CatalogItem& item, const std::string& dir) {
  std::ofstream(fs::path(dir) / "model.txt") << item.sku;
  return {0, R"({"code":"OK","message":"fine","triangles":12})"};
}

/// Each item behaves as its sku says.
ItemOutcome as_named(const CatalogItem& item, const std::string& dir) {
  std::ofstream(fs::path(dir) / "model.txt") << item.sku;
  const std::string what = item.sku.substr(0, item.sku.find('-'));
  if (what == "abort") std::abort();
  if (what == "kill") ::raise(SIGKILL);
  if (what == "hang")
    for (;;) ::pause();
  if (what == "leave") ::_exit(0);
  if (what == "silent") return {0, ""};
  if (what == "array") return {0, "[1]"};
  if (what == "broken") return {0, "{\"code\":"};
  if (what == "deep") return {0, "{\"a\":" + std::string(5000, '[') + std::string(5000, ']') + "}"};
  if (what == "long") return {0, "{\"a\":\"" + std::string(2u << 20, 'x') + "\"}"};
  if (what == "throw") throw std::runtime_error("no such thing");
  if (what == "refuse") return {65, R"({"code":"LOW_CONTRAST","message":"garment and board are too much alike"})"};
  if (what == "missing") return {66, R"({"code":"NO_FILE","message":"photo is missing"})"};
  return {0, R"({"code":"OK","message":""})"};
}

}  // namespace

TEST_F(RunCatalog, puts_each_result_into_the_folder_of_its_sku) {
  const CatalogSummary s = run(items({"b", "a"}), well);
  EXPECT_EQ(s.exit_code, 0);
  EXPECT_EQ(s.total, 2);
  EXPECT_EQ(s.ok, 2);
  EXPECT_EQ(read(root / "out/a/model.txt"), "a");
  EXPECT_EQ(read(root / "out/b/model.txt"), "b");
  EXPECT_EQ(s.report, (root / "out/report.jsonl").string());
  EXPECT_EQ(
      report(),
      (std::vector<std::string>{
          R"({"sku":"a","garment":"vest","status":"ok","exit_code":0,"code":"OK","message":"fine","triangles":12,"outputs":{"a/model.txt":"ca978112ca1bbdcafac231b39a23dc4da786eff8147c4e72b9807785afee48bb"}})",
          R"({"sku":"b","garment":"vest","status":"ok","exit_code":0,"code":"OK","message":"fine","triangles":12,"outputs":{"b/model.txt":"3e23e8160039594a33894f6564e1b1348bbd7a0088d42c4acb73eeaed59c009d"}})"}));
  expect_nothing_partial();
}

TEST_F(RunCatalog, gives_the_same_report_for_any_number_of_jobs) {
  std::vector<std::string> skus;
  for (int i = 0; i < 24; ++i)
    skus.push_back((i % 5 == 2    ? "refuse-"
                    : i % 7 == 3  ? "abort-"
                    : i % 11 == 4 ? "silent-"
                                  : "good-") +
                   std::to_string(i));
  // Earlier items take longer, so that they end out of order when several run at once.
  const ItemFunction convert = [](const CatalogItem& item, const std::string& dir) {
    const int i = std::atoi(item.sku.substr(item.sku.find('-') + 1).c_str());
    ::usleep(static_cast<useconds_t>((i % 4 == 0 ? 4 : 1) * 3000));
    return as_named(item, dir);
  };
  std::string first;
  for (const int jobs : {1, 2, 4}) {
    options.jobs = jobs;
    options.out_dir = (root / std::to_string(jobs)).string();
    run(items(skus), convert);
    const std::string text = read(root / std::to_string(jobs) / "report.jsonl");
    if (first.empty()) first = text;
    EXPECT_FALSE(text.empty());
    EXPECT_EQ(text, first) << jobs << " jobs";
  }
}

TEST_F(RunCatalog, never_runs_more_workers_than_jobs) {
  options.jobs = 3;
  const fs::path running = root / "running";
  fs::create_directory(running);
  const ItemFunction convert = [&](const CatalogItem& item, const std::string&) {
    std::ofstream(running / item.sku) << 1;
    const auto count = std::distance(fs::directory_iterator(running), {});
    ::usleep(5000);
    fs::remove(running / item.sku);
    return ItemOutcome{count <= 3 ? 0 : 65, R"({"code":"COUNT","message":""})"};
  };
  EXPECT_EQ(run(items({"a", "b", "c", "d", "e", "f", "g", "h", "i", "j"}), convert).ok, 10);
}

TEST_F(RunCatalog, a_crash_is_the_crashed_items_status_and_nobody_elses) {
  options.jobs = 2;
  const CatalogSummary s = run(items({"good-1", "abort-2", "kill-3", "good-4"}), as_named);
  EXPECT_EQ(s.ok, 2);
  EXPECT_EQ(s.crashed, 2);
  EXPECT_EQ(s.exit_code, 1);
  EXPECT_THAT(report()[0], HasSubstr(R"("status":"crashed","exit_code":70,"code":"CRASHED")"));
  EXPECT_THAT(report()[0], HasSubstr("SIGABRT"));
  EXPECT_THAT(report()[3], HasSubstr("SIGKILL"));
  EXPECT_TRUE(has("good-1"));
  EXPECT_FALSE(has("abort-2"));
  EXPECT_TRUE(has("good-4"));
  expect_nothing_partial();
}

TEST_F(RunCatalog, a_hang_ends_at_the_time_limit) {
  options.jobs = 2;
  options.item_seconds = 0.3;
  const CatalogSummary s = run(items({"hang-1", "good-2"}), as_named);
  EXPECT_EQ(s.timed_out, 1);
  EXPECT_EQ(s.ok, 1);
  EXPECT_THAT(report()[1], HasSubstr(R"("status":"timeout","exit_code":70,"code":"TIMED_OUT")"));
  EXPECT_FALSE(has("hang-1"));
  expect_nothing_partial();
}

TEST_F(RunCatalog, what_an_item_started_dies_with_it) {
  options.item_seconds = 0.3;
  const fs::path pid_file = root / "pid";
  run(items({"a"}), [&](const CatalogItem&, const std::string&) -> ItemOutcome {
    const pid_t grandchild = ::fork();
    if (grandchild == 0)
      for (;;) ::pause();
    std::ofstream(pid_file) << grandchild;
    for (;;) ::pause();
  });
  const pid_t grandchild = std::atoi(read(pid_file).c_str());
  ASSERT_GT(grandchild, 0);
  // It is not our child to wait for: it is gone, or a zombie that init has yet to collect.
  for (int i = 0; i < 200 && ::kill(grandchild, 0) == 0; ++i) {
    std::ifstream stat("/proc/" + std::to_string(grandchild) + "/stat");
    std::string line;
    std::getline(stat, line);
    if (line.empty() || line.find(") Z ") != std::string::npos) return;
    ::usleep(10000);
  }
  EXPECT_NE(::kill(grandchild, 0), 0);
}

TEST_F(RunCatalog, an_item_without_a_usable_report_has_failed) {
  const std::vector<std::string> skus{"array-3", "broken-4", "deep-5", "leave-1", "long-6", "silent-2", "throw-7"};
  const CatalogSummary s = run(items(skus), as_named);
  EXPECT_EQ(s.failed, static_cast<int>(skus.size()));
  const auto lines = report();
  ASSERT_EQ(lines.size(), skus.size());
  for (std::size_t i = 0; i < skus.size(); ++i) {
    EXPECT_THAT(lines[i], HasSubstr(R"("status":"failed","exit_code":70)")) << skus[i];
    EXPECT_THAT(lines[i], HasSubstr(skus[i][0] == 't' ? "no such thing" : "NO_REPORT"));
    EXPECT_FALSE(has(skus[i]));
  }
}

TEST_F(RunCatalog, a_refused_item_goes_to_quarantine_with_its_reason_and_links_to_its_photos) {
  auto list = items({"refuse-1", "good-2"});
  list[0].front = write("front.JPG", "pixels");
  list[0].title = "A vest";
  const CatalogSummary s = run(list, as_named);
  EXPECT_EQ(s.refused, 1);
  EXPECT_EQ(s.exit_code, 1);
  EXPECT_FALSE(has("refuse-1"));
  EXPECT_TRUE(has("quarantine/refuse-1/model.txt"));
  EXPECT_EQ(read(root / "out/quarantine/refuse-1/photo-front.JPG"), "pixels");
  const std::string reason = read(root / "out/quarantine/refuse-1/reason.json");
  for (const char* part : {"LOW_CONTRAST", "too much alike", "front.JPG", "A vest"})
    EXPECT_THAT(reason, HasSubstr(part));
  EXPECT_THAT(report()[1], HasSubstr(R"("status":"refused","exit_code":65,"code":"LOW_CONTRAST")"));
}

TEST_F(RunCatalog, the_exit_code_is_1_when_more_items_are_not_ok_than_were_allowed) {
  const auto list = items({"missing-1", "abort-2", "good-3", "good-4"});
  EXPECT_EQ(run(list, as_named).exit_code, 1);
  options.fail_share = 0.5;
  EXPECT_EQ(run(list, as_named).exit_code, 0);
  options.fail_share = 0.49;
  EXPECT_EQ(run(list, as_named).exit_code, 1);
  options.fail_share = 1;
  EXPECT_EQ(run(items({"missing-1", "abort-2"}), as_named).exit_code, 0);
}

TEST_F(RunCatalog, a_later_run_replaces_earlier_results) {
  options.force = true;
  run(items({"a", "b"}), [](const CatalogItem&, const std::string& dir) {
    std::ofstream(fs::path(dir) / "old.txt") << "old";
    return ItemOutcome{0, "{}"};
  });
  run(items({"a", "b"}), [](const CatalogItem& item, const std::string& dir) {
    if (item.sku == "b") std::abort();
    return well(item, dir);
  });
  EXPECT_TRUE(has("a/model.txt"));
  EXPECT_FALSE(has("a/old.txt"));
  EXPECT_FALSE(has("b")) << "what the report calls crashed has no model";
  expect_nothing_partial();
}

TEST_F(RunCatalog, a_stale_partial_folder_is_cleared) {
  fs::create_directories(root / "out/.vitrine-catalog/work/a/deep");
  fs::create_directories(root / "out/.vitrine-catalog/work/gone");
  std::ofstream(root / "out/.vitrine-catalog/work/a/stale.txt") << 1;
  run(items({"a"}), well);
  EXPECT_TRUE(has("a/model.txt"));
  EXPECT_FALSE(has("a/stale.txt"));
  expect_nothing_partial();
}

TEST_F(RunCatalog, folders_that_are_not_its_own_are_left_alone) {
  fs::create_directories(root / "out/a");
  std::ofstream(root / "out/a/mine.txt") << 1;
  const auto result = run_catalog(items({"a"}), options, well);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, "OUT_DIR_FOREIGN");
  EXPECT_EQ(result.error().exit_code(), 73);
  EXPECT_TRUE(has("a/mine.txt"));
}

TEST_F(RunCatalog, an_output_folder_that_cannot_be_made_is_an_error_73) {
  write("file", "");
  options.out_dir = (root / "file/out").string();
  const auto result = run_catalog(items({"a"}), options, well);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().exit_code(), 73);
  EXPECT_THAT(result.error().message, HasSubstr(options.out_dir));
}

TEST_F(RunCatalog, two_runs_do_not_write_to_one_folder) {
  const std::string path = options.out_dir;
  run(items({"a"}), [&](const CatalogItem& item, const std::string&) -> ItemOutcome {
    CatalogOptions other;
    other.out_dir = path;
    other.progress = ProgressKind::none;
    const auto second = run_catalog({item}, other, well);
    return {second ? 70 : second.error().exit_code(), "{\"code\":\"" + (second ? "" : second.error().code) + "\"}"};
  });
  EXPECT_THAT(report()[0], HasSubstr("\"exit_code\":75,\"code\":\"OUT_DIR_BUSY\""));
}

TEST_F(RunCatalog, an_unsafe_or_repeated_sku_never_reaches_the_disk) {
  for (const auto& skus :
       std::vector<std::vector<std::string>>{{"../a"}, {""}, {".."}, {"a", "a"}, {"quarantine"}, {"report.jsonl"}}) {
    const auto result = run_catalog(items(skus), options, well);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, "SKU_UNSAFE");
  }
  EXPECT_FALSE(fs::exists(root / "out"));
}

TEST_F(RunCatalog, a_stop_signal_ends_the_run_with_75_and_nothing_partial) {
  for (const int signal : {SIGINT, SIGTERM}) {
    options.out_dir = (root / "out").string();
    fs::remove_all(options.out_dir);
    const pid_t parent = ::getpid();
    const CatalogSummary s =
        run(items({"good-1", "stop-2", "never-3"}), [&](const CatalogItem& item, const std::string& dir) {
          if (item.sku == "stop-2") {
            ::kill(parent, signal);
            for (;;) ::pause();
          }
          return as_named(item, dir);
        });
    EXPECT_TRUE(s.interrupted);
    EXPECT_EQ(s.exit_code, 75);
    EXPECT_EQ(s.ok, 1);
    EXPECT_EQ(s.not_run, 2);
    ASSERT_EQ(report().size(), 3u);
    EXPECT_THAT(report()[2], HasSubstr(R"("status":"not_run","exit_code":75,"code":"INTERRUPTED")"));
    EXPECT_TRUE(has("good-1"));
    expect_nothing_partial();
  }
}

TEST_F(RunCatalog, the_callers_keys_cannot_change_what_the_run_states) {
  run(items({"a"}), [](const CatalogItem&, const std::string&) {
    return ItemOutcome{65,
                       "{\"sku\":\"x\",\"status\":\"ok\",\"exit_code\":0,\"code\":7,\"message\":\"a\\nb\",\"ms\":5}"};
  });
  const auto lines = report();
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_THAT(
      lines[0],
      StartsWith(
          R"({"sku":"a","garment":"vest","status":"refused","exit_code":65,"code":"","message":"a\nb","ms":5,"outputs":{)"));
}

TEST_F(RunCatalog, jobs_out_of_range_are_a_usage_error) {
  for (const int jobs : {0, -1, 257}) {
    options.jobs = jobs;
    const auto result = run_catalog(items({"a"}), options, well);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().exit_code(), 64);
  }
}

#if !defined(__SANITIZE_ADDRESS__)
TEST_F(RunCatalog, a_memory_limit_is_the_items_own_trouble) {
  options.item_memory = 512u << 20;
  const CatalogSummary s = run(items({"a"}), [](const CatalogItem&, const std::string&) {
    std::vector<char> much(std::size_t{2} << 30);
    much[much.size() / 2] = 1;
    return ItemOutcome{0, "{\"code\":\"" + std::to_string(much[much.size() / 2]) + "\"}"};
  });
  EXPECT_EQ(s.failed, 1);
  EXPECT_THAT(report()[0], HasSubstr("OUT_OF_MEMORY"));
}
#endif
