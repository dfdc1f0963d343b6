// SPDX-License-Identifier: GPL-3.0-or-later
// What a folder remembers from run to run.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <map>

#include "catalog_scratch.hpp"

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using namespace vitrine;
namespace fs = std::filesystem;

class Incremental : public CatalogScratch {
 protected:
  void SetUp() override {
    CatalogScratch::SetUp();
    for (const std::string sku : {"a", "b", "c"}) {
      CatalogItem item = items({sku}).front();
      item.front = write(sku + "-front.jpg", "front of " + sku);
      item.back = write(sku + "-back.jpg", "back of " + sku);
      list.push_back(item);
    }
    options.identity.engine = "1";
    options.identity.plugins = "vest 1";
    options.identity.settings = [this](const CatalogItem&) { return settings; };
  }
  /// Runs, and returns the items that were made.
  std::vector<std::string> made(const ItemFunction& convert = copy_photos) {
    const fs::path log = root / "made";
    fs::remove_all(log);
    fs::create_directory(log);
    last = run(list, [&](const CatalogItem& item, const std::string& dir) {
      std::ofstream(log / item.sku) << 1;
      return convert(item, dir);
    });
    std::vector<std::string> skus;
    for (const auto& entry : fs::directory_iterator(log)) skus.push_back(entry.path().filename().string());
    std::sort(skus.begin(), skus.end());
    return skus;
  }
  static ItemOutcome copy_photos(const CatalogItem& item, const std::string& dir) {
    if (!fs::exists(item.front)) return {66, R"({"code":"MISSING","message":"no photo"})"};
    std::ofstream(fs::path(dir) / "model.txt") << read(item.front) << read(item.back);
    return {0, "{}"};
  }
  std::string why(const std::string& sku) {
    const auto plan = plan_catalog(list, options);
    EXPECT_TRUE(plan);
    for (const PlannedItem& item : *plan)
      if (item.sku == sku) return (item.runs ? "runs: " : "") + item.why;
    return "no such item";
  }
  std::vector<CatalogItem> list;
  std::string settings = "draft";
  CatalogSummary last;
};

TEST_F(Incremental, nothing_is_made_twice_and_the_reports_stay_the_same_bytes) {
  EXPECT_THAT(made(), ElementsAre("a", "b", "c"));
  const auto first = tree(root / "out");
  EXPECT_THAT(made(), ElementsAre());
  EXPECT_EQ(last.unchanged, 3);
  EXPECT_EQ(last.ok, 3);
  EXPECT_EQ(tree(root / "out"), first);
  EXPECT_EQ(why("a"), "unchanged");
}

TEST_F(Incremental, each_thing_an_item_depends_on_makes_it_anew_and_is_named) {
  made();
  write("b-back.jpg", "another back");
  EXPECT_EQ(why("b"), "runs: back photo changed");
  EXPECT_THAT(made(), ElementsAre("b"));
  list[2].chest_cm = 46;
  EXPECT_EQ(why("c"), "runs: row changed");
  EXPECT_THAT(made(), ElementsAre("c"));
  settings = "fine";
  EXPECT_EQ(why("a"), "runs: settings changed");
  EXPECT_THAT(made(), ElementsAre("a", "b", "c"));
  options.identity.engine = "2";
  EXPECT_EQ(why("a"), "runs: engine changed");
  made();
  options.identity.plugins = "vest 2";
  EXPECT_EQ(why("a"), "runs: plugins changed");
  made();
  list[0].line = 77;
  EXPECT_EQ(why("a"), "unchanged") << "a row's place in the manifest is nothing that the item shows";
  options.force = true;
  EXPECT_EQ(why("a"), "runs: forced");
}

TEST_F(Incremental, a_photo_whose_size_and_time_were_made_the_same_again_is_still_seen_to_differ) {
  made();
  ::usleep(2'100'000);
  made();  // its stamp is kept now
  struct stat before;
  ASSERT_EQ(::stat(list[0].front.c_str(), &before), 0);
  write("a-front.jpg", "FRONT of a");
  const timespec times[2] = {before.st_atim, before.st_mtim};
  ASSERT_EQ(::utimensat(AT_FDCWD, list[0].front.c_str(), times, 0), 0);
  EXPECT_EQ(why("a"), "runs: front photo changed") << "its time of change cannot be set back";
}

TEST_F(Incremental, a_photo_written_just_before_the_run_is_read_again_by_the_next) {
  // A write within the same step of the file system's clock leaves the same stamp, so a young file's is not kept.
  EXPECT_THAT(made(), ElementsAre("a", "b", "c"));
  const fs::path journal = root / "out/.vitrine-catalog/journal.jsonl";
  const ::testing::Matcher<std::string> hash_only = ::testing::ContainsRegex("\"front\":\\[\"[0-9a-f]+\"\\]");
  const ::testing::Matcher<std::string> with_stamp = ::testing::ContainsRegex("\"front\":\\[\"[0-9a-f]+\",[0-9]+,");
  EXPECT_THAT(read(journal), hash_only);
  EXPECT_THAT(read(journal), ::testing::Not(with_stamp));
  ::usleep(2'100'000);
  EXPECT_THAT(made(), ElementsAre());
  EXPECT_THAT(read(journal), with_stamp) << "from now on a look at its times is enough";
  EXPECT_THAT(made(), ElementsAre());
  options.checksum = true;
  EXPECT_THAT(made(), ElementsAre());
}

TEST_F(Incremental, a_result_that_was_removed_or_changed_is_made_anew) {
  made();
  fs::remove(root / "out/a/model.txt");
  EXPECT_EQ(why("a"), "runs: a/model.txt is missing");
  std::ofstream(root / "out/b/model.txt") << "scribbled";
  EXPECT_EQ(why("b"), "runs: b/model.txt was changed");
  EXPECT_THAT(made(), ElementsAre("a", "b"));
  // A copy from a backup has other times and the same content.
  const std::string text = read(root / "out/c/model.txt");
  fs::remove(root / "out/c/model.txt");
  std::ofstream(root / "out/c/model.txt") << text;
  EXPECT_EQ(why("c"), "unchanged");
}

TEST_F(Incremental, a_refused_item_is_made_again_only_when_asked_or_changed) {
  const ItemFunction refuse = [](const CatalogItem& item, const std::string& dir) {
    return item.sku == "b" ? ItemOutcome{65, R"({"code":"BLURRED","message":"out of focus"})"} : copy_photos(item, dir);
  };
  made(refuse);
  EXPECT_EQ(last.refused, 1);
  EXPECT_THAT(made(), ElementsAre());
  EXPECT_EQ(last.refused, 1) << "it stays refused in the report";
  EXPECT_EQ(last.exit_code, 1);
  EXPECT_EQ(why("b"), "unchanged, refused before (BLURRED)");
  options.retry_refused = true;
  EXPECT_EQ(why("b"), "runs: refused before (BLURRED)");
  options.retry_refused = false;
  write("b-front.jpg", "in focus");
  EXPECT_THAT(made(), ElementsAre("b"));
  EXPECT_EQ(last.ok, 3);
  EXPECT_FALSE(fs::exists(root / "out/quarantine/b"));
}

TEST_F(Incremental, a_crashed_item_is_tried_once_more_and_then_only_when_asked) {
  const ItemFunction crash = [](const CatalogItem& item, const std::string& dir) {
    if (item.sku == "b") std::abort();
    return copy_photos(item, dir);
  };
  EXPECT_THAT(made(crash), ElementsAre("a", "b", "c"));
  EXPECT_EQ(why("b"), "runs: crashed before (CRASHED)");
  EXPECT_THAT(made(crash), ElementsAre("b"));
  EXPECT_THAT(made(crash), ElementsAre());
  EXPECT_EQ(last.crashed, 1);
  options.retry_failed = true;
  EXPECT_THAT(made(crash), ElementsAre("b"));
  options.retry_failed = false;
  list[1].chest_cm = 50;
  EXPECT_THAT(made(), ElementsAre("b")) << "with other inputs it is another item";
  EXPECT_EQ(last.ok, 3);
}

TEST_F(Incremental, an_item_that_could_not_be_written_is_always_tried_again) {
  const ItemFunction full = [](const CatalogItem&, const std::string&) {
    return ItemOutcome{73, R"({"code":"CANNOT_WRITE","message":"No space left on device"})"};
  };
  for (int i = 0; i < 4; ++i) EXPECT_THAT(made(full), ElementsAre("a", "b", "c"));
  EXPECT_EQ(last.failed, 3);
  EXPECT_THAT(made(), ElementsAre("a", "b", "c"));
  EXPECT_EQ(last.ok, 3);
}

TEST_F(Incremental, a_photo_that_changes_or_goes_during_the_run_makes_the_item_anew_next_time) {
  made([](const CatalogItem& item, const std::string& dir) {
    if (item.sku == "a") fs::remove(item.front);
    if (item.sku == "b") std::ofstream(item.front) << "replaced";
    return copy_photos(item, dir);
  });
  EXPECT_EQ(last.refused, 1);
  EXPECT_EQ(last.ok, 2);
  write("b-front.jpg", "front of b");
  EXPECT_EQ(why("b"), "runs: its photos changed while it was made");
  write("a-front.jpg", "front of a");
  EXPECT_THAT(made(), ElementsAre("a", "b")) << "although a's photo is what it was when the first run began";
  EXPECT_EQ(last.ok, 3);
}

TEST_F(Incremental, a_torn_or_foreign_line_of_the_journal_costs_that_item_only) {
  made();
  const fs::path journal = root / "out/.vitrine-catalog/journal.jsonl";
  const auto whole = tree(root / "out");
  std::ofstream(journal, std::ios::app) << "garbage\n{\"sku\":\"c\",\"key\":7}\n{\"sku\":\"a\",\"key\":\"torn";
  EXPECT_THAT(made(), ElementsAre());
  EXPECT_THAT(read(journal), ::testing::Not(HasSubstr("torn"))) << "cut off before anything is appended";
  EXPECT_EQ(tree(root / "out"), whole);
  fs::resize_file(journal, fs::file_size(journal) / 2);
  made();
  EXPECT_EQ(tree(root / "out"), whole);
}

TEST_F(Incremental, the_journal_does_not_grow_for_ever) {
  options.force = true;
  for (int i = 0; i < 60; ++i) made();
  const std::string text = read(root / "out/.vitrine-catalog/journal.jsonl");
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 120);
  options.force = false;
  EXPECT_THAT(made(), ElementsAre());
}

TEST_F(Incremental, results_that_were_not_flushed_before_a_power_cut_are_read_before_they_are_believed) {
  made();
  const fs::path journal = root / "out/.vitrine-catalog/journal.jsonl";
  std::string text = read(journal);
  const auto flush = text.rfind("{\"synced\":true}\n");
  ASSERT_NE(flush, std::string::npos);
  std::ofstream(journal) << text.substr(0, flush);
  // The length is on the disk, the bytes are not, and the clock has the same reading.
  const fs::path model = root / "out/a/model.txt";
  struct stat s;
  ASSERT_EQ(::stat(model.c_str(), &s), 0);
  const std::string zeros(static_cast<std::size_t>(s.st_size), '\0');
  const int fd = ::open(model.c_str(), O_WRONLY);
  ASSERT_EQ(::pwrite(fd, zeros.data(), zeros.size(), 0), s.st_size);
  ::close(fd);
  EXPECT_THAT(made(), ElementsAre("a"));
}

TEST_F(Incremental, a_size_run_of_which_some_were_made_is_partly_there) {
  const ItemFunction sizes = [](const CatalogItem& item, const std::string& dir) {
    if (item.sku != "b") return copy_photos(item, dir);
    for (const char* size : {"M", "quarantine/XXL"}) {
      fs::create_directories(fs::path(dir) / size);
      std::ofstream(fs::path(dir) / size / "model.txt") << size;
    }
    return ItemOutcome{65, R"({"code":"TOO_TIGHT","message":"XXL does not fit"})", true};
  };
  made(sizes);
  EXPECT_EQ(last.partly, 1);
  EXPECT_EQ(last.exit_code, 1);
  EXPECT_TRUE(fs::exists(root / "out/b/M/model.txt"));
  EXPECT_FALSE(fs::exists(root / "out/b/quarantine"));
  EXPECT_TRUE(fs::exists(root / "out/quarantine/b/XXL/model.txt"));
  EXPECT_TRUE(fs::exists(root / "out/quarantine/b/reason.json"));
  EXPECT_THAT(made(), ElementsAre());
  options.force = true;
  made();
  EXPECT_EQ(last.ok, 3);
  EXPECT_FALSE(fs::exists(root / "out/quarantine/b")) << "what is no longer so goes";
}
