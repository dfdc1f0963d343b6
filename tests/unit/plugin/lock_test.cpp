// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/host/lock.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "given.hpp"
#include "vitrine/host/registry.hpp"

namespace vitrine {
namespace {

namespace fs = std::filesystem;
using test::shipped;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Lock : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "vitrine-lock-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder = fs::canonical(name);
    for (const char* plugin : {"vest", "skirt"}) {
      const fs::path file = folder / (std::string(plugin) + ".vitrine.so");
      fs::copy_file(shipped / file.filename(), file);
      ::chmod(file.c_str(), 0755);
    }
    file = folder / "plugins.lock";
  }
  void TearDown() override { fs::remove_all(folder); }
  PluginRegistry load(const fs::path& lock) const {
    PluginSearch search{{}, {folder}, false};
    search.lock = lock;
    return PluginRegistry::load(search);
  }
  void write(const std::string& text) const { std::ofstream(file) << text; }
  fs::path folder, file;
};

TEST_F(Lock, lets_in_what_it_lists_and_nothing_else) {
  write(lock_text(load("")));
  const auto all = load(file);
  EXPECT_EQ(all.plugins().size(), 2u);
  EXPECT_FALSE(all.problem());

  fs::remove(folder / "skirt.vitrine.so");
  write(lock_text(load("")));
  fs::copy_file(shipped / "skirt.vitrine.so", folder / "skirt.vitrine.so");
  ::chmod((folder / "skirt.vitrine.so").c_str(), 0755);
  const auto some = load(file);
  EXPECT_EQ(some.plugins().size(), 1u);
  ASSERT_EQ(some.rejected().size(), 1u);
  EXPECT_EQ(some.rejected()[0].error.code, "PLUGIN_NOT_LOCKED");
  EXPECT_THAT(some.rejected()[0].error.message, AllOf(HasSubstr("skirt.vitrine.so"), HasSubstr("SHA-256")));
  EXPECT_FALSE(some.problem());  // it was found in a folder, nobody asked for it
}

TEST_F(Lock, notices_a_file_of_which_one_byte_is_different) {
  write(lock_text(load("")));
  {
    std::fstream io(folder / "vest.vitrine.so", std::ios::in | std::ios::out | std::ios::binary | std::ios::ate);
    io << ' ';  // behind the end: it would still load
  }
  const auto registry = load(file);
  EXPECT_EQ(registry.find_garment("vest"), nullptr);
  EXPECT_NE(registry.find_garment("skirt"), nullptr);
  ASSERT_TRUE(registry.problem());
  EXPECT_EQ(registry.problem()->code, "PLUGIN_LOCK_MISSING");
  EXPECT_THAT(registry.problem()->message, HasSubstr("org.vitrine.vest"));
}

TEST_F(Lock, names_the_plugins_that_are_missing) {
  write(lock_text(load("")));
  fs::remove(folder / "vest.vitrine.so");
  const auto registry = load(file);
  ASSERT_TRUE(registry.problem());
  EXPECT_EQ(registry.problem()->code, "PLUGIN_LOCK_MISSING");
  EXPECT_THAT(registry.problem()->message, AllOf(HasSubstr("org.vitrine.vest"), testing::Not(HasSubstr("skirt"))));
}

TEST_F(Lock, is_the_same_text_whatever_the_order_of_the_folder) {
  const std::string text = lock_text(load(""));
  EXPECT_LT(text.find("org.vitrine.skirt"), text.find("org.vitrine.vest"));
  write(text);
  const auto rows = read_lock(file);
  ASSERT_TRUE(rows);
  EXPECT_EQ(rows->size(), 2u);
}

TEST_F(Lock, that_is_broken_loads_nothing_and_names_the_line) {
  const std::string hash(64, 'a');
  const std::pair<const char*, std::string> cases[] = {
      {"", ""},
      {"line 1", "plugins 7\n"},
      {"line 2", "vitrine-plugins-lock 1\nzz  org.example.a  1.0.0\n"},
      {"line 2", "vitrine-plugins-lock 1\n" + hash + "  org.example.a\n"},
      {"line 3", "vitrine-plugins-lock 1\n" + hash + "  org.example.a  1.0.0\n" + hash + "  org.example.a  1.0.1\n"},
      {"line 2", "vitrine-plugins-lock 1\n" + std::string(100'000, 'x')}};
  for (const auto& [where, text] : cases) {
    write(text);
    const auto registry = load(file);
    EXPECT_TRUE(registry.plugins().empty());
    ASSERT_TRUE(registry.problem()) << text.substr(0, 80);
    EXPECT_EQ(registry.problem()->code, "PLUGIN_LOCK_FORM");
    EXPECT_THAT(registry.problem()->message, HasSubstr(where));
  }
  EXPECT_EQ(load(folder / "absent.lock").problem()->code, "MISSING");
}

// Whoever may rename a folder above can put another one in its place.
TEST_F(Lock, folders_above_have_to_be_safe_too) {
  fs::create_directories(folder / "open" / "plugins");
  fs::copy_file(folder / "vest.vitrine.so", folder / "open/plugins/vest.vitrine.so");
  const auto code = [&] {
    const auto registry = PluginRegistry::load({{}, {folder / "open/plugins"}, false});
    return registry.rejected().empty() ? std::string("loaded") : registry.rejected()[0].error.code;
  };
  EXPECT_EQ(code(), "loaded");
  ::chmod((folder / "open").c_str(), 0777);
  EXPECT_EQ(code(), "PLUGIN_FILE_TRUST");
  ::chmod((folder / "open").c_str(), 01777);  // as /tmp: only owners may rename there
  EXPECT_EQ(code(), "loaded");
}

}  // namespace
}  // namespace vitrine
