// SPDX-License-Identifier: GPL-3.0-or-later
// What can go wrong in a night: each item's trouble is its own, and nothing that is left is half of something.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "run.hpp"

using namespace vitrine::test;
using ::testing::HasSubstr;

namespace {

using Json = nlohmann::json;

/// One row for each name; the photos are the sample's terracotta vest under that name.
fs::path shop(const fs::path& folder, const std::vector<std::string>& skus) {
  fs::create_directories(folder);
  std::ofstream manifest(folder / "manifest.csv");
  manifest << "sku,garment,front,back,chest_cm\n";
  for (const std::string& sku : skus) {
    for (const char* side : {"-front.jpg", "-back.jpg"})
      fs::copy_file(sample + "vest-terracotta" + side, folder / (sku + side), fs::copy_options::overwrite_existing);
    manifest << sku << ",vest," << sku << "-front.jpg," << sku << "-back.jpg,46\n";
  }
  return folder / "manifest.csv";
}

std::map<std::string, Json> report_of(const fs::path& out) {
  std::map<std::string, Json> lines;
  std::istringstream text(slurp(out / "report.jsonl"));
  for (std::string line; std::getline(text, line);) {
    const Json json = Json::parse(line);
    EXPECT_TRUE(lines.emplace(json.at("sku"), json).second) << "twice: " << line;
  }
  return lines;
}

/// Every output that the report names is there, with the hash's content and nothing more.
void expect_whole(const fs::path& out) {
  for (const auto& [sku, line] : report_of(out)) {
    std::size_t files = 0;
    const bool made = line.at("status") == "ok";
    EXPECT_EQ(fs::exists(out / sku), made) << sku;
    if (made)
      for (const auto& entry : fs::directory_iterator(out / sku)) files += entry.is_regular_file();
    EXPECT_EQ(files, made ? line.at("outputs").size() : 0u) << sku;
    if (made) {
      const std::string glb = slurp(out / sku / "garment.glb");
      ASSERT_GT(glb.size(), 12u);
      std::uint32_t length = 0;
      std::memcpy(&length, glb.data() + 8, 4);
      EXPECT_EQ(length, glb.size()) << sku << ": the GLB states its own length";
    }
  }
  EXPECT_TRUE(fs::is_empty(out / ".vitrine-catalog/work"));
}

std::string run_command(const fs::path& manifest, const fs::path& out, const std::string& more = "") {
  return "-q catalog run '" + manifest.string() + "' --quality draft --out '" + out.string() + "' " + more;
}

}  // namespace

TEST(CatalogFaults, crash_hang_hunger_a_full_disk_and_a_photo_that_goes_are_each_that_items_status) {
  const fs::path folder = scratch(), out = folder / "out";
  const fs::path manifest =
      shop(folder / "shop", {"crash-1", "eat-1", "full-1", "gone-1", "good-1", "good-2", "hang-1", "spin-1"});
  const std::string preload = "env LD_PRELOAD='" + std::string(VITRINE_FAULTS) + "' ";
  const Outcome night = run_vitrine(
      run_command(manifest, out, "--jobs 2 --item-seconds 60 --item-cpu 6 --item-memory 1500M"), "2>&1", preload);
  EXPECT_EQ(night.exit_code, 1) << night.text;
  const auto lines = report_of(out);
  ASSERT_EQ(lines.size(), 8u);
  EXPECT_EQ(lines.at("crash-1").at("code"), "CRASHED");
  EXPECT_THAT(lines.at("crash-1").at("message"), HasSubstr("SIGABRT"));
  EXPECT_EQ(lines.at("hang-1").at("status"), "timeout");
  EXPECT_THAT(lines.at("hang-1").at("message"), HasSubstr("longer than 60 s"));
  EXPECT_EQ(lines.at("spin-1").at("status"), "timeout");
  EXPECT_THAT(lines.at("spin-1").at("message"), HasSubstr("6 s of processor time"));
  EXPECT_EQ(lines.at("eat-1").at("status"), "failed");
  EXPECT_EQ(lines.at("full-1").at("status"), "failed");
  EXPECT_EQ(lines.at("full-1").at("exit_code"), 73);
  EXPECT_THAT(lines.at("full-1").at("message"), HasSubstr("No space left"));
  EXPECT_EQ(lines.at("gone-1").at("status"), "refused");
  EXPECT_EQ(lines.at("gone-1").at("exit_code"), 66);
  EXPECT_TRUE(fs::exists(out / "quarantine/gone-1/reason.json"));
  for (const char* good : {"good-1", "good-2"}) EXPECT_EQ(lines.at(good).at("status"), "ok") << lines.at(good);
  expect_whole(out);

  // The next night without the faults, and with the photo back.
  shop(folder / "shop", {"crash-1", "eat-1", "full-1", "gone-1", "good-1", "good-2", "hang-1", "spin-1"});
  const Outcome next = run_vitrine(run_command(manifest, out, "--jobs 2"));
  EXPECT_EQ(next.exit_code, 0) << next.text;
  expect_whole(out);
}

TEST(CatalogFaults, a_disk_that_is_really_full_leaves_nothing_half_written_and_the_run_goes_on_when_there_is_room) {
  const fs::path folder = scratch(), disk = folder / "disk";
  fs::create_directories(disk);
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=5m") != 0)
    GTEST_SKIP() << "a small disk cannot be mounted without the right to do so";
  const fs::path manifest = shop(folder / "shop", {"a", "b", "c", "d", "e", "f"});
  const Outcome full = run_vitrine(run_command(manifest, disk / "out"));
  EXPECT_TRUE(full.exit_code == 73 || full.exit_code == 1) << full.text;
  int whole = 0;
  for (const char* sku : {"a", "b", "c", "d", "e", "f"}) whole += fs::exists(disk / "out" / sku / "report.json");
  EXPECT_GT(whole, 0);
  EXPECT_LT(whole, 6) << "the disk was to be too small";
  EXPECT_EQ(::mount("tmpfs", disk.c_str(), "tmpfs", MS_REMOUNT, "size=100m"), 0);
  const Outcome roomy = run_vitrine(run_command(manifest, disk / "out", "--why"), "2>&1");
  EXPECT_EQ(roomy.exit_code, 0) << roomy.text;
  EXPECT_THAT(roomy.text, HasSubstr("not made: unchanged")) << "what had been made is kept";
  expect_whole(disk / "out");
  EXPECT_EQ(::umount2(disk.c_str(), MNT_DETACH), 0);
}

TEST(CatalogFaults, an_output_that_may_not_be_written_ends_the_run_with_73_before_anything_is_made) {
  const fs::path folder = scratch();
  const fs::path manifest = shop(folder / "shop", {"a"});
  std::ofstream(folder / "file") << 1;
  const Outcome run = run_vitrine(run_command(manifest, folder / "file/out"));
  EXPECT_EQ(run.exit_code, 73);
  EXPECT_THAT(run.text, HasSubstr("file/out"));
  if (::mount("tmpfs", folder.c_str(), "tmpfs", MS_RDONLY, "size=1m") != 0) return;
  const Outcome read_only = run_vitrine(run_command(sample + "manifest.csv", folder / "out"));
  EXPECT_EQ(::umount2(folder.c_str(), MNT_DETACH), 0);
  EXPECT_EQ(read_only.exit_code, 73);
  EXPECT_THAT(read_only.text, HasSubstr("remedy"));
}

TEST(CatalogFaults, mistakes_of_the_set_up_end_with_their_own_codes) {
  const fs::path folder = scratch();
  const fs::path manifest = shop(folder / "shop", {"a"});
  EXPECT_EQ(run_vitrine(run_command(folder / "none.csv", folder / "out")).exit_code, 66);
  std::ofstream(folder / "broken.csv") << "sku,garment\n";
  EXPECT_EQ(run_vitrine(run_command(folder / "broken.csv", folder / "out")).exit_code, 78);
  EXPECT_EQ(run_vitrine(run_command(manifest, folder / "out", "--plugin " + manifest.string())).exit_code, 78);
  for (const char* wrong : {"--shard 8/8", "--shard x", "--fail-on 5", "--item-memory lots", "--mannequins M,m",
                            "--mannequin woman-m --mannequins S,M"})
    EXPECT_EQ(run_vitrine(run_command(manifest, folder / "out", wrong)).exit_code, 64) << wrong;
  EXPECT_FALSE(fs::exists(folder / "out/report.jsonl"));
}

TEST(CatalogFaults, the_real_program_killed_at_some_moments_leaves_the_bytes_of_an_undisturbed_run) {
  const fs::path folder = scratch();
  const auto bytes_of = [](const fs::path& out) {
    std::map<std::string, std::string> files;
    for (auto at = fs::recursive_directory_iterator(out); at != decltype(at)(); ++at) {
      if (at->path().filename() == ".vitrine-catalog") at.disable_recursion_pending();
      if (at->is_regular_file() && at->path().filename() != "timings.jsonl")
        files[fs::relative(at->path(), out).string()] = slurp(at->path());
    }
    return files;
  };
  ASSERT_EQ(run_vitrine(run_command(sample + "manifest.csv", folder / "calm")).exit_code, 0);
  const auto calm = bytes_of(folder / "calm");
  const fs::path out = folder / "out";
  for (const int tenths : {4, 13, 27, 41}) {
    const Outcome killed = run_vitrine(run_command(sample + "manifest.csv", out, "--jobs 2"), "2>&1",
                                       "timeout -s KILL " + std::to_string(tenths / 10.0) + " ");
    if (killed.exit_code == 0) break;  // a machine that is faster than that
  }
  ASSERT_EQ(run_vitrine(run_command(sample + "manifest.csv", out, "--jobs 2")).exit_code, 0);
  const auto after = bytes_of(out);
  ASSERT_EQ(after.size(), calm.size());
  for (const auto& [file, bytes] : calm) {
    ASSERT_TRUE(after.count(file)) << file;
    EXPECT_TRUE(after.at(file) == bytes) << file;
  }
}

TEST(CatalogFaults, a_size_of_a_size_run_has_the_bytes_of_a_run_on_that_mannequin_alone) {
  const fs::path folder = scratch();
  const fs::path manifest = shop(folder / "shop", {"a"});
  const Outcome run = run_vitrine(run_command(manifest, folder / "run", "--mannequins S,man-xl"));
  ASSERT_EQ(run.exit_code, 0) << run.text;
  ASSERT_EQ(run_vitrine(run_command(manifest, folder / "s", "--mannequin woman-s")).exit_code, 0);
  ASSERT_EQ(run_vitrine(run_command(manifest, folder / "xl", "--mannequin man-xl")).exit_code, 0);
  for (const char* file : {"garment.glb", "dressed.glb", "preview.png", "report.json", "thumb.jpg"}) {
    EXPECT_TRUE(slurp(folder / "run/a/S" / file) == slurp(folder / "s/a" / file)) << file;
    EXPECT_TRUE(slurp(folder / "run/a/man-xl" / file) == slurp(folder / "xl/a" / file)) << file;
  }
  EXPECT_FALSE(slurp(folder / "run/a/S/dressed.glb") == slurp(folder / "run/a/man-xl/dressed.glb"));
}
