// SPDX-License-Identifier: GPL-3.0-or-later
// vitrine plugin validate, checks, lock and inspect, as a user calls them.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "run.hpp"

namespace vitrine::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string plugins = std::string(VITRINE_BINARY_DIR) + "/lib/vitrine-1/plugins/";

TEST(Validate, nothing_is_no_success) {
  for (const std::string& files : {std::string(), std::string("absent.vitrine.so"), plugins + "absent.vitrine.so"}) {
    const Outcome run = run_vitrine("plugin validate " + files);
    EXPECT_EQ(run.exit_code, 69) << files;
    EXPECT_THAT(run.text, HasSubstr(files.empty() ? "0 passed, 0 failed, 0 skipped" : "1 failed")) << files;
  }
}

TEST(Validate, ends_with_its_counts_and_exits_0_when_all_is_well) {
  const Outcome run = run_vitrine("plugin validate --level 3 " + plugins + "vest.vitrine.so");
  EXPECT_EQ(run.exit_code, 0) << run.text;
  EXPECT_THAT(run.text, testing::ContainsRegex("[0-9]+ passed, 0 failed, [0-9]+ skipped\n$"));
}

TEST(Validate, a_file_that_is_no_library_fails_its_check) {
  const fs::path folder = scratch(), file = folder / "text.vitrine.so";
  std::ofstream(file) << "this is no library";
  const Outcome run = run_vitrine("plugin validate --level 6 " + file.string());
  EXPECT_EQ(run.exit_code, 69);
  EXPECT_THAT(run.text, HasSubstr("failed  load.library"));
}

TEST(Validate, one_check_alone_is_reported_alone) {
  const Outcome run = run_vitrine("plugin validate --all --only hardening.readonly " + plugins + "skirt.vitrine.so");
  EXPECT_EQ(run.exit_code, 0) << run.text;
  EXPECT_THAT(run.text, HasSubstr("passed  hardening.readonly"));
  EXPECT_THAT(run.text, HasSubstr("1 passed, 0 failed, 0 skipped"));
  EXPECT_EQ(run_vitrine("plugin validate --only luck " + plugins + "skirt.vitrine.so").exit_code, 64);
}

TEST(Validate, json_is_the_same_bytes_twice_and_says_what_was_checked) {
  const std::string command = "plugin validate --json - " + plugins + "neck_v.vitrine.so";
  const Outcome once = run_vitrine(command, "2>/dev/null"), twice = run_vitrine(command, "2>/dev/null");
  EXPECT_EQ(once.text, twice.text);
  const auto json = nlohmann::json::parse(once.text);
  EXPECT_EQ(json["abi"], "1.0");
  EXPECT_EQ(json["ok"], true);
  const auto& file = json["files"][0];
  EXPECT_EQ(file["id"], "org.vitrine.neck_v");
  EXPECT_EQ(file["sha256"].get<std::string>().size(), 64u);
  EXPECT_EQ(file["checks"].size(), json["passed"].get<std::size_t>() + json["skipped"].get<std::size_t>());
  EXPECT_EQ(file["checks"][0]["name"], "load.file");
}

TEST(Validate, photos_of_the_author_are_converted) {
  const std::string command = "plugin validate --only pipeline.photos --photo ";
  EXPECT_EQ(run_vitrine(command + sample + "vest-sailor-front.jpg " + plugins + "vest.vitrine.so").exit_code, 0);
  const Outcome other = run_vitrine(command + sample + "vest-sailor-front.jpg " + plugins + "skirt.vitrine.so");
  EXPECT_EQ(other.exit_code, 69);
  EXPECT_THAT(other.text, HasSubstr("failed  pipeline.photos"));
}

TEST(Checks, stand_in_the_documentation_as_they_are) {
  const Outcome run = run_vitrine("plugin checks --markdown");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(slurp(std::string(VITRINE_SOURCE_DIR) + "/docs/VALIDATE.md"), HasSubstr(run.text));
}

TEST(Lock, is_written_and_kept) {
  const fs::path lock = scratch() / "plugins.lock";
  ASSERT_EQ(run_vitrine("plugin lock --out " + lock.string()).exit_code, 0);
  EXPECT_EQ(run_vitrine("plugin list --lock " + lock.string()).exit_code, 0);
  std::string text = slurp(lock);
  const std::size_t at = text.find("  org.vitrine.vest");
  ASSERT_NE(at, std::string::npos);
  text[at - 1] = text[at - 1] == '0' ? '1' : '0';
  std::ofstream(lock) << text;
  const Outcome run =
      run_vitrine("convert --garment vest --mirror-back --front " + sample + "vest-sailor-front.jpg --out " +
                  (lock.parent_path() / "out").string() + " --lock " + lock.string());
  EXPECT_EQ(run.exit_code, 69);
  EXPECT_THAT(run.text, HasSubstr("PLUGIN_LOCK_MISSING"));
  EXPECT_THAT(run.text, HasSubstr("org.vitrine.vest"));
}

TEST(List, lives_through_plugins_that_crash_and_says_so) {
  const fs::path folder = scratch();
  for (const char* name : {"crashes", "exits"}) {
    const fs::path file = folder / (std::string(name) + ".vitrine.so");
    fs::copy_file(std::string(VITRINE_BINARY_DIR) + "/tests/bad_plugins/" + name + ".vitrine.so", file);
    fs::permissions(file, fs::perms::owner_all);
  }
  fs::permissions(folder, fs::perms::owner_all);
  const Outcome run = run_vitrine("plugin list --plugin-dir " + folder.string());
  EXPECT_EQ(run.exit_code, 0) << run.text;
  EXPECT_THAT(run.text, HasSubstr("vest"));
  EXPECT_THAT(run.text, HasSubstr("PLUGIN_FILE_CRASH"));
  EXPECT_THAT(run.text, HasSubstr("PLUGIN_FILE_EXIT"));
  const Outcome asked = run_vitrine("features --garment vest --front " + sample + "vest-sailor-front.jpg --plugin " +
                                    (folder / "crashes.vitrine.so").string());
  EXPECT_EQ(asked.exit_code, 69);
  EXPECT_THAT(asked.text, HasSubstr("signal 11"));
}

TEST(Inspect, draws_necklines_and_lays_a_template_over_a_photo) {
  const fs::path folder = scratch();
  EXPECT_THAT(run_vitrine("plugin inspect neck_u --svg -").text, HasSubstr("<svg"));
  const std::string png = (folder / "over.png").string();
  EXPECT_EQ(run_vitrine("plugin inspect vest --photo " + sample + "vest-sailor-front.jpg --png " + png).exit_code, 0);
  EXPECT_EQ(slurp(png).substr(1, 3), "PNG");
  EXPECT_EQ(run_vitrine("plugin inspect vest --photo " + sample + "vest-sailor-front.jpg").exit_code, 64);
  // A photo that is refused is drawn as well: that is when one wants to see it.
  fs::remove(png);
  EXPECT_EQ(run_vitrine("plugin inspect skirt --photo " + sample + "vest-sailor-front.jpg --png " + png).exit_code, 65);
  EXPECT_TRUE(fs::exists(png));
}

// Every garment with every neckline in every fabric: the whole of what ships, in one run.
TEST(WholeProduct, of_what_ships_passes_up_to_determinism) {
  const Outcome run = run_vitrine("plugin validate --level 5 " + plugins + "*.vitrine.so", "2>/dev/null");
  EXPECT_EQ(run.exit_code, 0) << run.text;
  EXPECT_THAT(run.text, HasSubstr(" 0 failed"));
}

}  // namespace
}  // namespace vitrine::test
