// SPDX-License-Identifier: GPL-3.0-or-later
// One catalogue in several shares, and what is made of their reports.
#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "catalog_scratch.hpp"

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using namespace vitrine;
namespace fs = std::filesystem;

class Shards : public CatalogScratch {
 protected:
  void SetUp() override {
    CatalogScratch::SetUp();
    std::vector<std::string> skus;
    for (int i = 0; i < 40; ++i) skus.push_back("item-" + std::to_string(i));
    list = items(skus);
    for (std::size_t i = 0; i < list.size(); i += 3) list[i].garment = "skirt";
  }
  static ItemOutcome convert(const CatalogItem& item, const std::string& dir) {
    std::ofstream(fs::path(dir) / "model.txt") << item.sku << item.garment;
    if (item.sku == "item-7") return {65, R"({"code":"BLURRED","message":"out of focus"})"};
    if (item.sku == "item-11") std::abort();
    return {0, R"({"residual":0.001})"};
  }
  void run_shard(int index, int of, const std::string& out) {
    options.out_dir = (root / out).string();
    options.shard = index;
    options.shards = of;
    run(list, convert);
  }
  MergedSummary merge(const std::vector<std::string>& from, const std::string& out) {
    std::vector<std::string> folders;
    for (const std::string& name : from) folders.push_back((root / name).string());
    const auto merged = merge_catalog(folders, (root / out).string(), 0);
    EXPECT_TRUE(merged) << (merged ? "" : merged.error().message);
    return merged ? *merged : MergedSummary{};
  }
  std::vector<CatalogItem> list;
};

TEST_F(Shards, every_item_is_in_exactly_one_shard_whatever_the_manifest_around_it) {
  for (const int n : {1, 2, 7, 100}) {
    std::map<int, int> sizes;
    for (int i = 0; i < 2000; ++i) {
      const int shard = shard_of("SKU-" + std::to_string(i), n);
      ASSERT_GE(shard, 0);
      ASSERT_LT(shard, n);
      ++sizes[shard];
    }
    EXPECT_EQ(static_cast<int>(sizes.size()), n) << "no shard is empty";
    for (const auto& [shard, size] : sizes)
      EXPECT_NEAR(size, 2000.0 / n, 6 * std::sqrt(2000.0 / n)) << shard << "/" << n;
  }
  EXPECT_EQ(shard_of("vest-sailor", 8), 0);
  EXPECT_EQ(shard_of("skirt-denim", 1000), 202) << "the shards of a catalogue that was begun must stay";
}

TEST_F(Shards, workers_order_and_shards_make_no_difference_to_any_byte) {
  run(list, convert);
  const auto whole = tree(root / "out");
  EXPECT_EQ(whole.count("report.html"), 1u);
  for (const int jobs : {2, 4}) {
    options.jobs = jobs;
    options.out_dir = (root / ("jobs-" + std::to_string(jobs))).string();
    std::reverse(list.begin(), list.end());
    std::rotate(list.begin(), list.begin() + 7, list.end());
    run(list, convert);
    EXPECT_EQ(tree(options.out_dir), whole) << jobs << " jobs, shuffled";
  }
  for (int i = 0; i < 7; ++i) run_shard(i, 7, "together");
  EXPECT_EQ(merge({"together"}, "together").exit_code, 1);
  EXPECT_EQ(tree(root / "together"), whole) << "seven shards in one folder";

  std::vector<std::string> apart;
  for (int i = 0; i < 7; ++i) {
    apart.push_back("apart-" + std::to_string(i));
    run_shard(i, 7, apart.back());
  }
  const MergedSummary merged = merge(apart, "collected");
  EXPECT_EQ(merged.total, 40);
  EXPECT_EQ(merged.crashed, 1);
  EXPECT_EQ(merged.refused, 1);
  EXPECT_EQ(tree(root / "collected"), whole) << "seven shards on seven machines";
}

TEST_F(Shards, missing_shards_are_named_and_ask_for_another_run) {
  for (const int i : {0, 1, 3, 4}) run_shard(i, 5, "out");
  MergedSummary merged = merge({"out"}, "out");
  EXPECT_THAT(merged.missing, ElementsAre(2));
  EXPECT_EQ(merged.exit_code, 75);
  EXPECT_EQ(merged.total + merged.without_report, 40);
  EXPECT_GT(merged.without_report, 0);
  EXPECT_THAT(read(root / "out/report.html"), HasSubstr("Shards without a report: 2 of 5"));
  EXPECT_THAT(read(root / "out/summary.json"), HasSubstr("missing_shards"));
  run_shard(2, 5, "out");
  merged = merge({"out"}, "out");
  EXPECT_THAT(merged.missing, ElementsAre());
  EXPECT_EQ(merged.total, 40);
}

TEST_F(Shards, a_shard_that_did_not_run_again_since_the_catalogue_changed_is_missing) {
  for (int i = 0; i < 3; ++i) run_shard(i, 3, "out");
  list.pop_back();
  for (const int i : {0, 2}) run_shard(i, 3, "out");
  EXPECT_THAT(merge({"out"}, "out").missing, ElementsAre(1));
}

TEST_F(Shards, another_number_of_shards_still_knows_what_was_made) {
  run(list, convert);
  options.retry_failed = false;
  int made = 0;
  for (int i = 0; i < 4; ++i) {
    options.shard = i;
    options.shards = 4;
    const CatalogSummary s = run(list, convert);
    made += s.total - s.unchanged;
  }
  EXPECT_EQ(made, 1) << "only the crashed item is tried once more";
}

TEST_F(Shards, share_a_folder_but_no_shard_runs_twice_and_no_whole_run_beside_them) {
  options.shard = 0;
  options.shards = 2;
  run(list, [&](const CatalogItem& item, const std::string& dir) {
    if (item.sku != "item-0" && shard_of("item-0", 2) == 0) return convert(item, dir);
    CatalogOptions other = options;
    const auto same = run_catalog(list, other, convert);
    other.shard = 1;
    const auto next = run_catalog(list, other, convert);
    other.shards = 1;
    other.shard = 0;
    const auto whole = run_catalog(list, other, convert);
    const bool right =
        !same && same.error().code == "OUT_DIR_BUSY" && next && !whole && whole.error().code == "OUT_DIR_BUSY";
    return ItemOutcome{right ? 0 : 65, "{}"};
  });
  EXPECT_EQ(read(root / "out/shards/0-of-2/report.jsonl").find("\"status\":\"refused\",\"exit_code\":65,\"code\":\"\""),
            std::string::npos);
}

TEST_F(Shards, that_do_not_exist_are_a_usage_error) {
  for (const auto& [i, n] : std::vector<std::pair<int, int>>{{2, 2}, {-1, 2}, {0, 0}, {0, 10001}}) {
    options.shard = i;
    options.shards = n;
    const auto result = run_catalog(list, options, convert);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, "SHARD");
  }
  const auto none = merge_catalog({(root / "nowhere").string()}, (root / "out").string(), 0);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().exit_code(), 66);
}
