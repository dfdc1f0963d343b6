// SPDX-License-Identifier: GPL-3.0-or-later
// Somebody who has installed Vitrine and writes a plugin.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "shell.hpp"

using namespace vitrine::test;
using testing::HasSubstr;
using testing::Not;

namespace {

/// Stands in for the program where only what CMake does with it is of interest.
fs::path program_that_says(const fs::path& folder, const std::string& words, int exit_code) {
  const fs::path program = folder / "vitrine";
  spit(program, "#!/bin/sh\necho \"$@\" >" + quoted(folder / "asked") + "\nprintf '" + words + "'\nexit " +
                    std::to_string(exit_code) + "\n");
  fs::permissions(program, fs::perms::owner_all);
  return program;
}

Outcome configure(const fs::path& project, const fs::path& prefix, const std::string& more = "") {
  return shell(cmake + " -S " + quoted(project) + " -B " + quoted(project / "build") +
               " -DCMAKE_PREFIX_PATH=" + quoted(prefix) + " " + more);
}

fs::path started(const fs::path& prefix, const fs::path& folder, const std::string& name, const std::string& kind) {
  const Outcome run =
      shell(quoted(prefix / "bin/vitrine") + " plugin new " + name + " " + kind + " --dir " + quoted(folder / name));
  EXPECT_EQ(run.exit_code, 0) << run.text;
  return folder / name;
}

std::string exported(const fs::path& library) {
  return shell("nm -D --defined-only " + quoted(library) + " | cut -d ' ' -f 3").text;
}

}  // namespace

TEST(SdkConsumer, makes_a_poncho_out_of_the_starter_in_under_forty_lines_and_five_minutes) {
  const fs::path out = scratch();
  const Outcome run = shell(quoted(source / "scripts/try-sdk") + " " + quoted(build) + " " + quoted(out));
  EXPECT_EQ(run.exit_code, 0) << run.text;
  for (const char* made : {"garment.glb", "dressed.glb", "preview.png"}) EXPECT_TRUE(fs::exists(out / "look" / made));
  const std::string report = slurp(out / "look/report.json");
  EXPECT_THAT(report, HasSubstr("\"warnings\": []"));
  EXPECT_THAT(report, HasSubstr("\"id\": \"neck_u\""));
}

TEST(SdkConsumer, builds_both_starters_as_they_are_and_the_program_takes_them) {
  const fs::path out = scratch(), prefix = out / "prefix";
  install(prefix, {"host", "plugins", "sdk"});
  for (const std::string kind : {"garment", "neckline"}) {
    const fs::path project = started(prefix, out, "my_" + kind, "--" + kind);
    const Outcome built =
        shell("cd " + quoted(project) + " && " + cmake + " -B build -DCMAKE_PREFIX_PATH=" + quoted(prefix) +
              " -DCMAKE_CXX_FLAGS=-Werror && " + cmake + " --build build");
    ASSERT_EQ(built.exit_code, 0) << built.text;
    EXPECT_THAT(built.text, Not(HasSubstr("warning")));
    const fs::path plugin = project / ("build/my_" + kind + ".vitrine.so");
    EXPECT_EQ(exported(plugin), "vitrine_plugin_entry\n");
    const Outcome list = shell(quoted(prefix / "bin/vitrine") + " plugin list --plugin " + quoted(plugin));
    EXPECT_EQ(list.exit_code, 0) << list.text;
    EXPECT_THAT(list.text, HasSubstr("org.example.my_" + kind + " 1.0.0"));
    EXPECT_THAT(list.text, HasSubstr("org.vitrine.vest"));
  }
}

// The starter is a sleeveless top and says so: the sample vest is one.
TEST(SdkConsumer, converts_a_photo_with_the_starter_as_it_is) {
  const fs::path out = scratch(), prefix = out / "prefix";
  install(prefix, {"host", "plugins", "sdk"});
  const fs::path project = started(prefix, out, "top", "");
  const Outcome built = shell("cd " + quoted(project) + " && " + cmake +
                              " -B build -DCMAKE_PREFIX_PATH=" + quoted(prefix) + " && " + cmake + " --build build");
  ASSERT_EQ(built.exit_code, 0) << built.text;
  const fs::path photos = source / "catalog/sample";
  const Outcome run =
      shell(quoted(prefix / "bin/vitrine") + " -q convert --quality draft --garment top --plugin " +
            quoted(project / "build/top.vitrine.so") + " --front " + quoted(photos / "vest-sailor-front.jpg") +
            " --back " + quoted(photos / "vest-sailor-back.jpg") + " --out " + quoted(out / "look"));
  EXPECT_EQ(run.exit_code, 0) << run.text;
}

TEST(SdkConsumer, is_told_at_configure_time_that_the_program_for_the_tests_is_missing) {
  const fs::path out = scratch(), prefix = out / "prefix";
  install(prefix, {"host", "plugins", "sdk"});
  const fs::path project = started(prefix, out, "cape", "");
  fs::remove(prefix / "bin/vitrine");
  const Outcome run = configure(project, prefix);
  EXPECT_NE(run.exit_code, 0);
  EXPECT_THAT(run.text, HasSubstr("the program vitrine is not there"));
  const Outcome named = configure(project, prefix, "-DVITRINE_PROGRAM=" + quoted(out / "nowhere"));
  EXPECT_NE(named.exit_code, 0);
  EXPECT_THAT(named.text, HasSubstr("the program vitrine is not there"));
}

TEST(SdkConsumer, conformance_test_asks_the_program_and_believes_only_checks_that_ran) {
  const fs::path out = scratch(), prefix = out / "prefix";
  install(prefix, {"host", "plugins", "sdk"});
  const fs::path project = started(prefix, out, "cape", "");
  const auto verdict = [&](const std::string& words, int exit_code) {
    fs::remove_all(project / "build");
    const fs::path program = program_that_says(out, words, exit_code);
    const Outcome run = configure(project, prefix, "-DVITRINE_PROGRAM=" + quoted(program));
    EXPECT_EQ(run.exit_code, 0) << run.text;
    EXPECT_EQ(shell(cmake + " --build " + quoted(project / "build")).exit_code, 0);
    return shell("ctest --no-tests=error --test-dir " + quoted(project / "build")).exit_code;
  };
  EXPECT_EQ(verdict("21 passed, 0 failed, 2 skipped\\n", 0), 0);
  EXPECT_EQ(slurp(out / "asked"),
            "plugin validate " + (project / "build/cape.vitrine.so").string() + " --level 5 --timeout 300\n");
  EXPECT_NE(verdict("20 passed, 1 failed, 2 skipped\\n", 1), 0);
  EXPECT_NE(verdict("0 passed, 0 failed, 0 skipped\\n", 0), 0);
}

// The program refuses plugins in folders that others may write; an installation must not make such folders.
TEST(SdkConsumer, trusts_what_was_installed_under_a_loose_umask) {
  const fs::path prefix = scratch() / "prefix";
  const mode_t before = umask(0002);
  install(prefix, {"host", "plugins", "sdk"});
  umask(before);
  const Outcome list = shell(quoted(prefix / "bin/vitrine") + " plugin list");
  EXPECT_EQ(list.exit_code, 0) << list.text;
  EXPECT_THAT(list.text, HasSubstr("org.vitrine.vest"));
  EXPECT_THAT(list.text, Not(HasSubstr("refused")));
}

TEST(SdkConsumer, gets_the_version_that_it_asks_for_or_none) {
  const fs::path out = scratch(), prefix = out / "prefix";
  install(prefix, {"sdk"});
  const auto found = [&](const std::string& version) {
    fs::remove_all(out / "project");
    fs::create_directories(out / "project");
    spit(out / "project/CMakeLists.txt",
         "cmake_minimum_required(VERSION 3.25)\nproject(asks LANGUAGES NONE)\n"
         "find_package(VitrineSDK " +
             version + " CONFIG REQUIRED)\n");
    return configure(out / "project", prefix).exit_code == 0;
  };
  EXPECT_TRUE(found("1.0"));
  EXPECT_FALSE(found("1.9"));
  EXPECT_FALSE(found("2.0"));
  EXPECT_FALSE(found("0.9"));
}

// Empty PATH-like hints and no libraries: what the program needs is not looked for.
TEST(SdkConsumer, installs_the_sdk_without_any_library_of_the_program) {
  const fs::path out = scratch();
  const Outcome run =
      shell(cmake + " -S " + quoted(source) + " -B " + quoted(out / "build") +
            " -DVITRINE_SDK_ONLY=ON -DCMAKE_FIND_ROOT_PATH=/nowhere -DCMAKE_FIND_ROOT_PATH_MODE_PACKAGE=ONLY"
            " -DCMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY && " +
            cmake + " --build " + quoted(out / "build") + " && " + cmake + " --install " + quoted(out / "build") +
            " --prefix " + quoted(out / "prefix"));
  ASSERT_EQ(run.exit_code, 0) << run.text;
  for (const char* file :
       {"include/vitrine/abi.h", "include/vitrine/templates/torso.hpp", "share/cmake/VitrineSDK/VitrineSDKConfig.cmake",
        "share/vitrine-1/starter/shared/CMakeLists.txt"})
    EXPECT_TRUE(fs::exists(out / "prefix" / file)) << file;
}

// Whatever compiler and C++ library an author has: the same tables arrive.
TEST(OtherTools, plugins_by_clang_with_libcxx_and_by_gcc_with_debug_containers_mean_the_same) {
  const fs::path out = scratch(), prefix = out / "prefix";
  install(prefix, {"host", "plugins", "sdk"});
  const std::string vitrine = quoted(prefix / "bin/vitrine");
  std::string tables, drawing;
  const std::pair<std::string, std::string> tools[] = {
      {"gcc", std::string(VITRINE_GXX)},
      {"gcc-debug", std::string(VITRINE_GXX) + " -D_GLIBCXX_DEBUG -O0 -g"},
      {"clang", std::string(VITRINE_CLANGXX)},
      {"clang-libcxx", std::string(VITRINE_CLANGXX) + " -stdlib=libc++"}};
  for (const auto& [name, tool] : tools) {
    const fs::path project = out / name;
    fs::create_directories(project);
    fs::copy_file(source / "examples/poncho/poncho.cpp", project / "poncho.cpp");
    spit(project / "CMakeLists.txt",
         "cmake_minimum_required(VERSION 3.25)\nproject(poncho LANGUAGES CXX)\nfind_package(VitrineSDK 1.0 CONFIG "
         "REQUIRED)\nvitrine_add_plugin(poncho SOURCES poncho.cpp)\n");
    const std::size_t space = tool.find(' ');
    const std::string flags = space == std::string::npos ? "" : tool.substr(space + 1);
    const Outcome run =
        configure(project, prefix,
                  "-DCMAKE_CXX_COMPILER=" + tool.substr(0, space) + " -DCMAKE_CXX_FLAGS='-Werror " + flags + "'");
    ASSERT_EQ(run.exit_code, 0) << run.text;
    const Outcome built = shell(cmake + " --build " + quoted(project / "build"));
    ASSERT_EQ(built.exit_code, 0) << name << '\n' << built.text;
    const fs::path plugin = project / "build/poncho.vitrine.so";
    EXPECT_EQ(exported(plugin), "vitrine_plugin_entry\n") << name;
    // No C++ runtime is asked for, neither ours nor another one that would have to live beside it.
    EXPECT_THAT(shell("readelf -d " + quoted(plugin)).text, Not(HasSubstr("c++"))) << name;
    const Outcome inspected = shell(vitrine + " plugin inspect poncho --svg " + quoted(project / "poncho.svg") +
                                    " --plugin " + quoted(plugin));
    ASSERT_EQ(inspected.exit_code, 0) << name << '\n' << inspected.text;
    if (tables.empty()) tables = inspected.text, drawing = slurp(project / "poncho.svg");
    EXPECT_EQ(inspected.text, tables) << name;
    EXPECT_EQ(slurp(project / "poncho.svg"), drawing) << name;
    const Outcome seen = shell(quoted(build / "bin/draw-poncho") + " " + quoted(out / "front.png") + " " +
                               quoted(out / "back.png") + " && " + vitrine + " features --front " +
                               quoted(out / "front.png") + " --garment poncho --plugin " + quoted(plugin));
    EXPECT_EQ(seen.exit_code, 0) << name << '\n' << seen.text;
  }
}

TEST(OtherTools, code_that_an_author_adds_stays_inside_the_plugin) {
  const fs::path out = scratch(), prefix = out / "prefix";
  install(prefix, {"sdk"});
  spit(out / "helper.cpp",
       "#include <string>\nint helper(int n) { return static_cast<int>(std::to_string(n).size()); }\n");
  std::string text = slurp(source / "examples/poncho/poncho.cpp");
  text += "\n#include <vector>\nint helper(int);\nint not_exported() { return std::vector<int>(3, helper(12))[1]; }\n";
  spit(out / "chatty.cpp", text);
  spit(out / "CMakeLists.txt",
       "cmake_minimum_required(VERSION 3.25)\nproject(chatty LANGUAGES CXX)\nfind_package(VitrineSDK 1.0 CONFIG "
       "REQUIRED)\nadd_library(helper STATIC helper.cpp)\nset_target_properties(helper PROPERTIES "
       "POSITION_INDEPENDENT_CODE ON)\nvitrine_add_plugin(chatty SOURCES chatty.cpp)\n"
       "target_link_libraries(vitrine_plugin_chatty PRIVATE helper)\n");
  const Outcome run = configure(out, prefix);
  ASSERT_EQ(run.exit_code, 0) << run.text;
  const Outcome built = shell(cmake + " --build " + quoted(out / "build"));
  ASSERT_EQ(built.exit_code, 0) << built.text;
  EXPECT_EQ(exported(out / "build/chatty.vitrine.so"), "vitrine_plugin_entry\n");
}

// Every plugin that the tree has built, wherever it lies, but for what tests make and delete meanwhile and for the
// broken ones, of which only the sound control counts.
TEST(OtherTools, every_built_plugin_exports_its_entry_and_nothing_else) {
  int seen = 0;
  for (auto entry = fs::recursive_directory_iterator(build); entry != fs::recursive_directory_iterator(); ++entry) {
    if (entry->path() == build / "tests" / "scratch") entry.disable_recursion_pending();
    const std::string name = entry->path().filename().string();
    const bool broken = entry->path().parent_path().filename() == "bad_plugins" && name != "sound.vitrine.so";
    if (!name.ends_with(".vitrine.so") || broken) continue;
    EXPECT_EQ(exported(entry->path()), "vitrine_plugin_entry\n") << entry->path();
    ++seen;
  }
  EXPECT_GE(seen, 6);
}
