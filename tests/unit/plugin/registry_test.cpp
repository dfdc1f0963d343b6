// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/host/registry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "given.hpp"

namespace vitrine {
namespace {

namespace fs = std::filesystem;
using test::shipped;
using ::testing::AllOf;
using ::testing::HasSubstr;

const fs::path broken = fs::path(VITRINE_BINARY_DIR) / "tests/bad_plugins";

/// A folder of its own that only this user may write, gone at the end.
class Registry : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "vitrine-plugins-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder = fs::canonical(name);
  }
  void TearDown() override { fs::remove_all(folder); }
  fs::path put(const char* plugin, const std::string& as) const {
    const fs::path to = folder / as;
    fs::copy_file(shipped / plugin, to);
    ::chmod(to.c_str(), 0755);
    return to;
  }
  static PluginRegistry load(std::vector<fs::path> files, std::vector<fs::path> folders = {}) {
    return PluginRegistry::load({std::move(files), std::move(folders), false});
  }
  static std::string code(const PluginRegistry& registry) {
    return registry.rejected().size() == 1 ? registry.rejected()[0].error.code
                                           : std::to_string(registry.rejected().size()) + " rejected";
  }
  fs::path folder;
};

TEST_F(Registry, finds_those_beside_the_program) {
  EXPECT_EQ(fs::weakly_canonical(built_in_plugin_folder()), fs::weakly_canonical(shipped));
  const auto registry = PluginRegistry::load({});
  for (const auto& rejected : registry.rejected()) ADD_FAILURE() << rejected.error.message;
  std::vector<std::string> garments, necklines;
  for (const auto& g : registry.garments()) garments.push_back(g.id);
  for (const auto& n : registry.necklines()) necklines.push_back(n.id);
  EXPECT_THAT(garments, testing::IsSupersetOf({"long_sleeve", "skirt", "vest"}));
  EXPECT_THAT(necklines, testing::IsSupersetOf({"neck_square", "neck_u", "neck_v"}));
  EXPECT_TRUE(std::is_sorted(garments.begin(), garments.end()));
  EXPECT_TRUE(std::is_sorted(necklines.begin(), necklines.end()));
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& file : fs::directory_iterator(shipped)) ++files;
  EXPECT_EQ(registry.plugins().size(), files);
  EXPECT_FALSE(registry.problem());
  ASSERT_NE(registry.find_garment("vest"), nullptr);
  EXPECT_EQ(registry.find_garment("vest")->plugin, "org.vitrine.vest");
  EXPECT_EQ(registry.find_garment("neck_u"), nullptr);
  EXPECT_NE(registry.find_neckline("neck_u"), nullptr);
}

TEST_F(Registry, takes_a_file_from_anywhere_when_it_is_named) {
  const auto registry = load({put("skirt.vitrine.so", "mine.vitrine.so")});
  EXPECT_EQ(registry.rejected().size(), 0u);
  EXPECT_NE(registry.find_garment("skirt"), nullptr);
  EXPECT_EQ(registry.plugins()[0].file, (folder / "mine.vitrine.so").string());
}

TEST_F(Registry, looks_only_at_files_with_the_plugin_suffix) {
  put("skirt.vitrine.so", "skirt.so");
  put("vest.vitrine.so", "vest.vitrine.so.old");
  const auto registry = load({}, {folder});
  EXPECT_TRUE(registry.plugins().empty());
  EXPECT_TRUE(registry.rejected().empty());
  EXPECT_EQ(code(load({folder / "skirt.so"})), "PLUGIN_FILE_NAME");
}

TEST_F(Registry, duplicate_id_names_both_files_and_keeps_the_first) {
  const fs::path first = put("vest.vitrine.so", "a.vitrine.so"), second = put("vest.vitrine.so", "b.vitrine.so");
  const auto registry = load({}, {folder});
  EXPECT_EQ(code(registry), "PLUGIN_DUPLICATE_ID");
  EXPECT_THAT(registry.rejected()[0].error.message, AllOf(HasSubstr(first.string()), HasSubstr(second.string())));
  EXPECT_EQ(registry.garments().size(), 1u);
  EXPECT_EQ(registry.plugins()[0].file, first.string());
  ASSERT_TRUE(registry.problem());
  EXPECT_EQ(registry.problem()->code, "PLUGIN_DUPLICATE_ID");
}

TEST_F(Registry, one_file_found_in_two_ways_is_no_duplicate) {
  const fs::path file = put("vest.vitrine.so", "vest.vitrine.so");
  fs::create_symlink(file, folder / "again.vitrine.so");
  const auto registry = load({file}, {folder});
  EXPECT_TRUE(registry.rejected().empty());
  EXPECT_EQ(registry.garments().size(), 1u);
}

TEST_F(Registry, refuses_files_and_folders_that_others_may_write) {
  const fs::path file = put("vest.vitrine.so", "vest.vitrine.so");
  for (const mode_t mode : {0775, 0757, 0777}) {
    ::chmod(file.c_str(), mode);
    EXPECT_EQ(code(load({file})), "PLUGIN_FILE_TRUST");
    EXPECT_EQ(code(load({}, {folder})), "PLUGIN_FILE_TRUST");
  }
  ::chmod(file.c_str(), 0755);
  EXPECT_EQ(code(load({file})), "0 rejected");
  ::chmod(folder.c_str(), 0777);
  EXPECT_EQ(code(load({file})), "PLUGIN_FILE_TRUST");
  EXPECT_EQ(code(load({}, {folder})), "PLUGIN_FILE_TRUST");
  ::chmod(folder.c_str(), 0700);
}

// Behind a link in a safe folder there may be a file in an unsafe one.
TEST_F(Registry, judges_the_file_behind_a_symbolic_link) {
  fs::create_directory(folder / "open");
  const fs::path file = put("vest.vitrine.so", "open/vest.vitrine.so");
  fs::create_symlink(file, folder / "link.vitrine.so");
  EXPECT_EQ(code(load({folder / "link.vitrine.so"})), "0 rejected");
  ::chmod((folder / "open").c_str(), 0777);
  const auto registry = load({folder / "link.vitrine.so"});
  EXPECT_EQ(code(registry), "PLUGIN_FILE_TRUST");
  EXPECT_THAT(registry.rejected()[0].error.message, HasSubstr((folder / "open").string()));
}

TEST_F(Registry, refuses_a_file_of_another_user) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give a file away";
  const fs::path file = put("vest.vitrine.so", "vest.vitrine.so");
  ASSERT_EQ(::chown(file.c_str(), 12345, 12345), 0);
  EXPECT_EQ(code(load({file})), "PLUGIN_FILE_TRUST");
}

TEST_F(Registry, never_searches_for_a_bare_name) {
  put("vest.vitrine.so", "vest.vitrine.so");
  const fs::path before = fs::current_path();
  fs::current_path(folder);
  const auto bare = load({"vest.vitrine.so"});
  const auto named = load({"./vest.vitrine.so"});
  const auto nothing = load({}, {""});
  fs::current_path(before);
  EXPECT_EQ(code(bare), "PLUGIN_FILE_NAME");
  EXPECT_EQ(code(named), "0 rejected");
  EXPECT_EQ(named.garments().size(), 1u);
  EXPECT_EQ(code(nothing), "PLUGIN_FOLDER_MISSING");
}

TEST_F(Registry, reports_what_is_no_library) {
  const fs::path text = folder / "text.vitrine.so", empty = folder / "empty.vitrine.so",
                 dir = folder / "dir.vitrine.so";
  std::ofstream(text) << "this is no library";
  std::ofstream{empty};
  fs::create_directory(dir);
  for (const fs::path& file : {text, empty}) ::chmod(file.c_str(), 0644);
  EXPECT_EQ(code(load({text})), "PLUGIN_FILE_LOAD");
  EXPECT_EQ(code(load({empty})), "PLUGIN_FILE_LOAD");
  EXPECT_EQ(code(load({dir})), "PLUGIN_FILE_KIND");
  EXPECT_EQ(code(load({folder / "absent.vitrine.so"})), "PLUGIN_FILE_MISSING");
  EXPECT_EQ(code(load({}, {folder / "absent"})), "PLUGIN_FOLDER_MISSING");
  const auto registry = load({text});
  EXPECT_THAT(registry.rejected()[0].error.message, HasSubstr(text.string()));
  EXPECT_THAT(registry.rejected()[0].error.message, testing::Not(HasSubstr("Bad file descriptor")));
  ASSERT_TRUE(registry.problem());
}

// A download that broke off: the dynamic linker would end the process with SIGBUS.
TEST_F(Registry, survives_a_library_cut_off_anywhere) {
  std::ifstream in(shipped / "vest.vitrine.so", std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  ASSERT_GT(whole.size(), 8192u);
  int refused = 0;
  for (std::size_t length = 0; length < whole.size(); length = length * 3 / 2 + 61) {
    const fs::path file = folder / (std::to_string(length) + ".vitrine.so");
    std::ofstream(file, std::ios::binary) << whole.substr(0, length);
    ::chmod(file.c_str(), 0644);
    const auto registry = load({file});
    // What is left off at the very end (section names, debug information) is never mapped.
    if (registry.rejected().empty()) continue;
    EXPECT_EQ(code(registry), "PLUGIN_FILE_LOAD");
    ++refused;
  }
  EXPECT_GE(refused, 8);
}

TEST_F(Registry, reports_a_library_without_the_entry_and_one_with_undefined_symbols) {
  EXPECT_EQ(code(load({broken / "no_entry.vitrine.so"})), "PLUGIN_FILE_ENTRY");
  const auto registry = load({broken / "unresolved.vitrine.so"});
  EXPECT_EQ(code(registry), "PLUGIN_FILE_LOAD");
  EXPECT_THAT(registry.rejected()[0].error.message, HasSubstr("defined_nowhere"));
}

TEST_F(Registry, one_bad_file_does_not_keep_the_others_away) {
  std::ofstream(folder / "bad.vitrine.so") << "no";
  ::chmod((folder / "bad.vitrine.so").c_str(), 0644);
  put("neck_v.vitrine.so", "neck_v.vitrine.so");
  const auto registry = load({}, {folder});
  EXPECT_EQ(registry.rejected().size(), 1u);
  EXPECT_NE(registry.find_neckline("neck_v"), nullptr);
  EXPECT_FALSE(registry.problem()) << "a folder with one bad file is a warning, not the end";
}

}  // namespace
}  // namespace vitrine
