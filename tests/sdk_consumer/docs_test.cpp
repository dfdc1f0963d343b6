// SPDX-License-Identifier: GPL-3.0-or-later
// docs/PLUGINS.md is what an author follows, so it is followed here, word for word.
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "shell.hpp"

using namespace vitrine::test;
using testing::HasSubstr;

namespace {

/// The fenced blocks of a language, in order.
std::vector<std::string> blocks(const std::string& page, const std::string& language) {
  std::vector<std::string> found;
  std::istringstream lines(page);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      inside = line == "```" + language;
      if (inside) found.emplace_back();
    } else if (inside) {
      found.back() += line + "\n";
    }
  }
  return found;
}

const std::string page = slurp(source / "docs/PLUGINS.md");
const std::string poncho = slurp(source / "examples/poncho/poncho.cpp");

}  // namespace

TEST(PluginsPage, commands_run_in_a_clean_folder_with_only_the_installed_prefix) {
  const fs::path out = scratch(), prefix = out / "prefix";
  install(prefix, {"host", "plugins", "sdk"});
  fs::create_directories(out / "work");
  std::string script = "set -e -x\nexport HOME=" + quoted(out / "home") + " CMAKE_PREFIX_PATH=" + quoted(prefix) +
                       " PATH=" + quoted(prefix / "bin") + ":$PATH\ncd " + quoted(out / "work") + "\n" +
                       quoted(build / "bin/draw-poncho") + " front.jpg back.jpg\n";
  const auto commands = blocks(page, "sh");
  ASSERT_GE(commands.size(), 4u);
  for (std::size_t i = 0; i < commands.size(); ++i) {
    script += commands[i];
    // Then the author edits.
    if (i == 0) script += "cp " + quoted(prefix / "share/doc/vitrine-sdk/examples/poncho/poncho.cpp") + " .\n";
  }
  spit(out / "page.sh", script);
  const Outcome run = shell("bash " + quoted(out / "page.sh"));
  EXPECT_EQ(run.exit_code, 0) << run.text;
  for (const char* made : {"poncho.svg", "points.png", "look/dressed.glb", "look/preview.png", "plugins.lock"})
    EXPECT_TRUE(fs::exists(out / "work/poncho" / made)) << made;
}

TEST(PluginsPage, shows_the_poncho_as_it_is_and_counts_its_lines) {
  for (const std::string& block : blocks(page, "cpp")) {
    if (block.find("#include") != std::string::npos) continue;
    std::istringstream lines(block);
    for (std::string line; std::getline(lines, line);) EXPECT_THAT(poncho, HasSubstr(line + "\n"));
  }
  std::string starter = slurp(source / "templates/starter/garment/@name@.cpp");
  for (const auto& [place, value] : {std::pair<std::string, std::string>{"@name@", "poncho"}, {"@Title@", "Poncho"}})
    for (std::size_t at; (at = starter.find(place)) != std::string::npos;) starter.replace(at, place.size(), value);
  const fs::path out = scratch();
  spit(out / "starter.cpp", starter);
  const Outcome count = shell("diff " + quoted(out / "starter.cpp") + " " +
                              quoted(source / "examples/poncho/poncho.cpp") + " | grep -c '^>'");
  EXPECT_THAT(page, HasSubstr("That was all: " + count.text.substr(0, count.text.find('\n')) + " lines."));
}

TEST(PluginsPage, whole_examples_compile) {
  int compiled = 0;
  for (const std::string& block : blocks(page, "cpp")) {
    if (block.find("#include") == std::string::npos) continue;
    const fs::path file = scratch() / "example.cpp";
    spit(file, block);
    for (const std::string compiler : {VITRINE_GXX, VITRINE_CLANGXX}) {
      const Outcome run =
          shell(compiler + " -std=c++20 -Wall -Wextra -Werror -fsyntax-only -I " + quoted(source / "sdk/include") +
                " -I " + quoted(source / "templates/include") + " " + quoted(file));
      EXPECT_EQ(run.exit_code, 0) << run.text;
      ++compiled;
    }
  }
  EXPECT_EQ(compiled, 2);
}
