// SPDX-License-Identifier: GPL-3.0-or-later
// `vitrine plugin new` writes a whole project or nothing. What the project builds to is in tests/sdk_consumer.
#include <gmock/gmock.h>

#include "run.hpp"

using namespace vitrine::test;
using testing::HasSubstr;
using testing::Not;

namespace {

std::string in(const fs::path& folder) {
  return " --dir '" + folder.string() + "'";
}

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST(PluginNew, fills_the_name_in_everywhere) {
  for (const std::string kind : {"", " --garment", " --neckline"}) {
    const fs::path project = scratch() / "deep/rain_cape";
    const Outcome run = run_vitrine("plugin new rain_cape" + kind + in(project));
    ASSERT_EQ(run.exit_code, 0) << run.text;
    EXPECT_THAT(run.text, HasSubstr("rain_cape.cpp"));
    for (const char* file : {"CMakeLists.txt", "README.md", ".gitignore", "rain_cape.cpp"}) {
      const std::string text = slurp(project / file);
      EXPECT_FALSE(text.empty()) << file;
      EXPECT_THAT(text, Not(HasSubstr("@"))) << file;
    }
    EXPECT_THAT(slurp(project / "rain_cape.cpp"), HasSubstr("\"Rain cape\""));
    EXPECT_EQ(entries(project), 4u);
    EXPECT_EQ(entries(project.parent_path()), 1u) << "something was left aside";
  }
}

TEST(PluginNew, takes_an_empty_folder_and_refuses_a_full_one) {
  const fs::path project = scratch() / "cape";
  fs::create_directory(project);
  EXPECT_EQ(run_vitrine("plugin new cape" + in(project / "")).exit_code, 0);
  const std::string before = slurp(project / "cape.cpp");
  const Outcome again = run_vitrine("plugin new cape --neckline" + in(project));
  EXPECT_EQ(again.exit_code, 64);
  EXPECT_THAT(again.text, HasSubstr("not an empty folder"));
  EXPECT_EQ(slurp(project / "cape.cpp"), before);
}

TEST(PluginNew, refuses_names_that_no_plugin_may_have) {
  const fs::path folder = scratch();
  for (const std::string name : {"Cape", "1cape", "rain-cape", "cape.x", "../cape", "''", "c\xC3\xA4pe"}) {
    const Outcome run = run_vitrine("plugin new " + name + in(folder / "project"));
    EXPECT_EQ(run.exit_code, 64) << name;
    EXPECT_FALSE(fs::exists(folder / "project")) << name;
  }
  EXPECT_EQ(run_vitrine("plugin new " + std::string(65, 'a') + in(folder / "project")).exit_code, 64);
  const Outcome taken = run_vitrine("plugin new vest" + in(folder / "project"));
  EXPECT_EQ(taken.exit_code, 64);
  EXPECT_THAT(taken.text, HasSubstr("installed"));
  EXPECT_EQ(run_vitrine("plugin new cape --garment --neckline" + in(folder / "project")).exit_code, 64);
  EXPECT_EQ(entries(folder), 0u);
}

TEST(PluginNew, says_where_it_cannot_write) {
  const fs::path folder = scratch();
  std::ofstream(folder / "file") << "no folder";
  const Outcome run = run_vitrine("plugin new cape" + in(folder / "file/cape"));
  EXPECT_EQ(run.exit_code, 73);
  EXPECT_THAT(run.text, HasSubstr((folder / "file").string()));
  EXPECT_EQ(entries(folder), 1u);
}
