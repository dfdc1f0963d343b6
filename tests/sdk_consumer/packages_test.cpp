// SPDX-License-Identifier: GPL-3.0-or-later
// The Debian packages, made of the build tree and unpacked beside it.
#include <gmock/gmock.h>

#include <map>

#include "shell.hpp"

using namespace vitrine::test;
using testing::HasSubstr;
using testing::Not;

namespace {

/// Packs, and unpacks everything into `root`. Package name -> file.
std::map<std::string, fs::path> packed(const fs::path& out, const fs::path& root) {
  const Outcome run = shell(std::string(VITRINE_CPACK) + " --config " + quoted(build / "CPackConfig.cmake") + " -B " +
                            quoted(out / "packages"));
  EXPECT_EQ(run.exit_code, 0) << run.text;
  std::map<std::string, fs::path> files;
  for (const auto& entry : fs::directory_iterator(out / "packages")) {
    if (entry.path().extension() != ".deb") continue;
    const std::string name = entry.path().filename().string();
    files[name.substr(0, name.find('_'))] = entry.path();
    const Outcome unpacked = shell(std::string(VITRINE_DPKG_DEB) + " -x " + quoted(entry.path()) + " " + quoted(root));
    EXPECT_EQ(unpacked.exit_code, 0) << unpacked.text;
  }
  return files;
}

std::string field(const fs::path& package, const std::string& name) {
  return shell(std::string(VITRINE_DPKG_DEB) + " -f " + quoted(package) + " " + name).text;
}

}  // namespace

TEST(Packages, work_from_where_they_are_unpacked) {
  const fs::path out = scratch(), root = out / "root", usr = root / "usr";
  const auto files = packed(out, root);
  ASSERT_EQ(files.size(), 3u);
  ASSERT_TRUE(files.contains("vitrine") && files.contains("vitrine-plugins") && files.contains("vitrine-sdk"));

  // The program needs libraries by package, and the plugins; plugins and SDK need nothing.
  const std::string needs = field(files.at("vitrine"), "Depends");
  EXPECT_THAT(needs, HasSubstr("libopencv-imgcodecs"));
  EXPECT_THAT(needs, HasSubstr("libc6 (>="));
  EXPECT_THAT(needs, HasSubstr("vitrine-plugins (= " VITRINE_VERSION ")"));
  EXPECT_EQ(field(files.at("vitrine-plugins"), "Depends"), "\n");
  EXPECT_EQ(field(files.at("vitrine-sdk"), "Depends"), "\n");
  EXPECT_EQ(field(files.at("vitrine-sdk"), "Architecture"), "all\n");
  EXPECT_THAT(shell(std::string(VITRINE_DPKG_DEB) + " -c " + quoted(files.at("vitrine-plugins"))).text,
              Not(HasSubstr("drwxrwxr-x")));

  EXPECT_THAT(slurp(usr / "share/doc/vitrine/copyright"), HasSubstr("GNU GENERAL PUBLIC LICENSE"));
  for (const char* package : {"vitrine-plugins", "vitrine-sdk"})
    EXPECT_THAT(slurp(usr / "share/doc" / package / "copyright"), HasSubstr("MIT License")) << package;
  for (const char* page : {"PLUGINS.md", "ABI.md"})
    EXPECT_TRUE(fs::exists(usr / "share/doc/vitrine-sdk" / page)) << page;

  const std::string vitrine = quoted(usr / "bin/vitrine");
  const Outcome list = shell(vitrine + " plugin list");
  EXPECT_EQ(list.exit_code, 0) << list.text;
  EXPECT_THAT(list.text, HasSubstr("org.vitrine.vest"));
  EXPECT_THAT(list.text, Not(HasSubstr("refused")));

  const Outcome made = shell("cd " + quoted(out) + " && " + vitrine + " plugin new cape && " + cmake +
                             " -S cape -B cape/build -DCMAKE_PREFIX_PATH=" + quoted(usr) + " && " + cmake +
                             " --build cape/build && " + vitrine + " plugin list --plugin cape/build/cape.vitrine.so");
  EXPECT_EQ(made.exit_code, 0) << made.text;
  EXPECT_THAT(made.text, HasSubstr("org.example.cape"));
}

TEST(Packages, program_without_the_sdk_says_what_is_missing) {
  const fs::path out = scratch(), prefix = out / "prefix";
  install(prefix, {"host"});
  const Outcome run = shell("cd " + quoted(out) + " && prefix/bin/vitrine plugin new cape");
  EXPECT_EQ(run.exit_code, 66) << run.text;
  EXPECT_THAT(run.text, HasSubstr("vitrine-sdk"));
  EXPECT_FALSE(fs::exists(out / "cape"));
}
