// SPDX-License-Identifier: GPL-3.0-or-later
// The check of the checks: each broken plugin fails the check that was made for it, and no other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "vitrine/host/child.hpp"
#include "vitrine/mannequin.hpp"
#include "vitrine/validate.hpp"

namespace vitrine {

void PrintTo(CheckStatus status, std::ostream* out) {
  *out << (status == CheckStatus::passed ? "passed" : status == CheckStatus::failed ? "failed" : "skipped");
}

namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

const fs::path broken = fs::path(VITRINE_BINARY_DIR) / "tests/bad_plugins";

struct Verdict {
  const char* check;        ///< the one that fails; empty: a sound plugin
  const char* reason = "";  ///< a part of its message
};

const std::map<std::string, Verdict> verdicts = {
    {"sound", {""}},
    {"sound_c", {""}},
    {"sound_neckline", {""}},
    {"sound_sleeves", {""}},
    {"sound_vest", {""}},
    {"crashes", {"load.start", "signal 11"}},
    {"aborts", {"load.start", "signal 6"}},
    {"throws", {"load.start"}},
    {"exits", {"load.start", "exit code 0"}},
    {"hangs", {"load.start", "hung"}},
    {"unresolved", {"load.start", "defined_nowhere"}},
    {"no_entry", {"load.entry", "does not export"}},
    {"wrong_magic", {"entry.magic"}},
    {"other_major", {"entry.abi_major", "ABI 2.0, this vitrine has ABI 1.0"}},
    {"newer_minor", {"entry.abi_minor", "ABI 1.1, this vitrine has ABI 1.0"}},
    {"short_entry", {"entry.size", "40 bytes"}},
    {"bad_id", {"entry.id", "Poncho"}},
    {"bad_version", {"entry.id", "\"1.0\""}},
    {"empty_plugin", {"entry.content"}},
    {"wild_pointer", {"memory.inside", "not the library's own"}},
    {"table_on_the_heap", {"memory.inside", "not the library's own"}},
    {"unaligned_table", {"memory.aligned"}},
    {"billion_features", {"span.count", "1000000000 elements"}},
    {"null_span", {"span.data"}},
    {"overflowing_stride", {"span.stride", "4294967288"}},
    {"no_title", {"text.present"}},
    {"long_text", {"text.length", "longer than 200 bytes"}},
    {"not_utf8", {"text.utf8", "not UTF-8 at byte 1"}},
    {"capital_name", {"name.form"}},
    {"twin_features", {"name.unique"}},
    {"missing_edge", {"name.known", "pocket"}},
    {"not_a_number", {"number.finite", "mass"}},
    {"endless_ease", {"number.range", "ease"}},
    {"cyclic_mirrors", {"mirror.involution"}},
    {"open_outline", {"outline.closed"}},
    {"corner_twice", {"outline.order"}},
    {"two_necks", {"outline.neck"}},
    {"missing_point", {"pose.complete"}},
    {"inside_out", {"pose.clockwise"}},
    {"sewn_hem", {"seam.kind"}},
    {"sewn_twice", {"seam.pairs"}},
    {"limb_of_a_corner", {"limb.corners"}},
    {"upside_down", {"scale.measurable"}},
    {"anchor_on_nothing", {"anchor.landmark"}},
    {"flat_neckline", {"neckline.profile"}},
    {"crossed_straps", {"pose.simple", "cross or touch"}},
    {"crooked_hem", {"pose.mirror", "hem"}},
    {"far_search", {"pose.radius", "neck_left"}},
    {"small_in_its_box", {"pose.size"}},
    {"left_on_the_right", {"landmark.side", "knee_left"}},
    {"unlike_landmarks", {"landmark.mirror", "ankle_right"}},
    {"unequal_seam", {"seam.length", "times as long"}},
    {"twisted_seam", {"seam.direction", "reversed should be 0"}},
    {"limb_inwards", {"limb.chain", "outwards"}},
    {"hangs_by_its_hem", {"anchor.top"}},
    {"neck_at_the_side", {"neck.edge"}},
    {"wavy_neckline", {"neckline.form"}},
    {"cloth_of_steel", {"fabric.believable", "stretch is 1e+07 N/m"}},
    {"corners_inside_out", {"pipeline.features"}},
    {"cloth_of_dough", {"pipeline.drape", "FABRIC_TOO_SOFT"}},
    {"named_by_chance", {"determinism.process"}},
    {"restless", {"determinism.tables"}},
    {"exports_more", {"hardening.exports", "another_symbol"}},
    {"needs_a_library", {"hardening.needs", "libz.so"}},
    {"searches", {"hardening.search", "/opt/example/lib"}},
    {"runs_its_stack", {"hardening.segments", "executable stack"}},
    {"writable_tables", {"hardening.readonly"}},
    {"wide", {"hardening.size", "20 MB"}},
    {"takes_memory", {"hardening.memory", "100 MB"}},
    {"starts_a_thread", {"hardening.threads", "1 threads"}},
    {"leaves_a_file_open", {"hardening.files", "/dev/null"}},
    {"prints", {"hardening.output", "Thank you"}},
    {"sets_a_variable", {"hardening.environment"}},
    {"handles_signals", {"hardening.signals"}},
    {"rounds_down", {"hardening.numbers", "rounding mode"}},
};

/// Checks that no table of a plugin can break by itself, each with how it is tested instead.
const std::set<std::string> not_by_a_plugin = {
    "load.file",           // the file's place and mode: ValidateFiles
    "load.library",        // a file that is no library: ValidateFiles
    "pipeline.panels",     // adoption and the feature room refuse what would fail here; kept for the engine's sake
    "pipeline.residual",   // outcomes of the drape: which garment misses them is the solver's affair
    "pipeline.seams",      //
    "pipeline.body",       //
    "pipeline.pieces",     //
    "pipeline.size",       //
    "pipeline.files",      // fails with what comes before it
    "pipeline.photos",     // photos of the user: tests/cli
    "determinism.repeat",  // a fault of the engine: tests/cli/sample_catalogue_test.cpp converts everything twice
    "hardening.stays",     // a library that unmaps itself ends in a crash as often as in a report
};

const CheckInfo& info_of(std::string_view name) {
  for (const CheckInfo& check : plugin_checks())
    if (check.name == name) return check;
  ADD_FAILURE() << "no check is called " << name;
  return plugin_checks().front();
}

std::shared_ptr<const Body> body() {
  static const auto made = [] {
    auto b = std::make_shared<Body>();
    b->mannequin = *build_mannequin(Measurements{});
    b->field = *voxelise(b->mannequin.mesh);
    return std::shared_ptr<const Body>(b);
  }();
  return made;
}

FileReport report_on(const fs::path& file, int level) {
  ValidateOptions options;
  options.level = level;
  options.partners.built_in = false;
  options.seconds = file.filename() == "hangs.vitrine.so" ? 1 : 120;
  options.program = std::string(VITRINE_BINARY_DIR) + "/bin/vitrine";
  if (level >= 4) options.body = body();
  const auto validation = validate_plugins({file.string()}, options);
  EXPECT_TRUE(validation);
  return validation->files.front();
}

class BadPlugins : public testing::TestWithParam<std::string> {};

TEST_P(BadPlugins, fails_its_check_and_no_other) {
  const Verdict& verdict = verdicts.at(GetParam());
  const bool sound = *verdict.check == '\0';
  // Up to the level of the check; sound ones up to the last, the garments among them once as a whole product.
  const FileReport report =
      report_on(broken / (GetParam() + ".vitrine.so"), sound ? max_check_level : info_of(verdict.check).level);
  std::vector<std::string> failed, passed;
  for (const CheckResult& check : report.checks) {
    if (check.status == CheckStatus::passed) passed.push_back(check.name);
    if (check.status != CheckStatus::failed) continue;
    failed.push_back(check.name);
    EXPECT_EQ(check.name, verdict.check) << check.message;
    EXPECT_THAT(check.message, HasSubstr(verdict.reason));
  }
  EXPECT_EQ(failed.size(), sound ? 0u : 1u);
  EXPECT_FALSE(passed.empty());
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& [name, verdict] : verdicts) all.push_back(name);
  return all;
}
INSTANTIATE_TEST_SUITE_P(Each, BadPlugins, testing::ValuesIn(names()), [](const auto& info) { return info.param; });

TEST(BadPlugins, are_all_in_the_table) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(broken)) {
    const std::string file = entry.path().filename().string();
    if (!file.ends_with(".vitrine.so")) continue;
    EXPECT_TRUE(verdicts.contains(file.substr(0, file.find('.')))) << file;
    ++files;
  }
  EXPECT_EQ(files, verdicts.size());
}

TEST(BadPlugins, break_every_check_that_a_plugin_can_break) {
  std::set<std::string> checks;
  for (const auto& [name, verdict] : verdicts) checks.insert(verdict.check);
  for (const CheckInfo& check : plugin_checks())
    EXPECT_NE(checks.contains(std::string(check.name)), not_by_a_plugin.contains(std::string(check.name)))
        << check.name;
}

// What a host does with them: it lives, says why, and uses the sound ones.
TEST(BadPlugins, together_in_a_folder_do_not_harm_the_host_or_hide_the_sound_ones) {
  std::map<std::string, Error> refused;
  bool found = false;
  // In a process of its own: what is loaded here would be in memory already when other tests load it.
  const ChildEnd end = run_in_child(
      {},
      [](const ChildReport& report) {
        PluginSearch search{{}, {broken}, false};
        search.rehearsal_seconds = 1;
        const PluginRegistry registry = PluginRegistry::load(search);
        if (registry.find_neckline("neck_plain_c") != nullptr) report.send("found");
        for (const RejectedPlugin& rejected : registry.rejected())
          report.send(fs::path(rejected.file).filename().string() + "\n" + rejected.error.code + "\n" +
                      rejected.error.message + "\n" + rejected.error.remedy);
      },
      [&](const std::string& record) {
        found = found || record == "found";
        std::istringstream lines(record);
        std::string file;
        Error error;
        std::getline(lines, file);
        std::getline(lines, error.code);
        std::getline(lines, error.message);
        std::getline(lines, error.remedy);
        refused[file] = error;
      });
  EXPECT_EQ(end.how, ChildEnd::How::finished) << end.text();
  EXPECT_TRUE(found);
  refused.erase("found");
  EXPECT_EQ(refused["crashes.vitrine.so"].code, "PLUGIN_FILE_CRASH");
  EXPECT_EQ(refused["aborts.vitrine.so"].code, "PLUGIN_FILE_CRASH");
  EXPECT_EQ(refused["exits.vitrine.so"].code, "PLUGIN_FILE_EXIT");
  EXPECT_EQ(refused["hangs.vitrine.so"].code, "PLUGIN_FILE_HANG");
  EXPECT_THAT(refused["throws.vitrine.so"].code, testing::AnyOf("PLUGIN_FILE_CRASH", "PLUGIN_FILE_LOAD"));
  for (const auto& [name, verdict] : verdicts)
    if (*verdict.check != '\0' && info_of(verdict.check).level <= 2) {
      EXPECT_TRUE(refused.contains(name + ".vitrine.so")) << name;
    }
  for (const auto& [file, error] : refused) {
    EXPECT_THAT(error.message, HasSubstr(file));
    EXPECT_FALSE(error.remedy.empty()) << file;
  }
}

TEST(BadPlugins, of_another_version_name_both_numbers_and_both_remedies) {
  const auto message = [](const char* plugin, const char* check) {
    for (const CheckResult& result : report_on(broken / plugin, 2).checks)
      if (result.name == check) return result.message;
    return std::string();
  };
  EXPECT_THAT(message("other_major.vitrine.so", "entry.abi_major"),
              AllOf(HasSubstr("2.0"), HasSubstr("1.0"), HasSubstr("Update vitrine"), HasSubstr("rebuild the plugin")));
  EXPECT_THAT(message("newer_minor.vitrine.so", "entry.abi_minor"),
              AllOf(HasSubstr("1.1"), HasSubstr("1.0"), HasSubstr("Update vitrine"), HasSubstr("rebuild the plugin")));
}

}  // namespace
}  // namespace vitrine
