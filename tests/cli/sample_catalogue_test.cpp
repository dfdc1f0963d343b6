// SPDX-License-Identifier: GPL-3.0-or-later
// The whole path on the sample catalogue, as scripts/demo runs it.
#include <nlohmann/json.hpp>
#include <sstream>

#include "run.hpp"

using namespace vitrine::test;

namespace {

/// Every file of a catalogue run but the processor times and what the folder remembers of files' times.
std::map<std::string, std::string> files_of(const fs::path& out) {
  std::map<std::string, std::string> files;
  for (auto at = fs::recursive_directory_iterator(out); at != decltype(at)(); ++at) {
    if (at->path().filename() == ".vitrine-catalog") at.disable_recursion_pending();
    if (at->is_regular_file() && at->path().filename() != "timings.jsonl")
      files[fs::relative(at->path(), out).string()] = slurp(at->path());
  }
  return files;
}

}  // namespace

TEST(SampleCatalogue, converts_with_the_same_bytes_on_one_and_two_workers_and_valid_gltf) {
  const fs::path folder = scratch();
  const Outcome one = run_vitrine("-q catalog run '" + sample + "manifest.csv' --quality draft --jobs 1 --out '" +
                                  (folder / "one").string() + "'");
  ASSERT_EQ(one.exit_code, 0) << one.text;
  const Outcome two = run_vitrine("-q catalog run '" + sample + "manifest.csv' --quality draft --jobs 2 --out '" +
                                  (folder / "two").string() + "'");
  ASSERT_EQ(two.exit_code, 0) << two.text;
  const auto first = files_of(folder / "one"), second = files_of(folder / "two");
  ASSERT_EQ(first.size(), second.size());
  for (const auto& [name, bytes] : first) {
    ASSERT_TRUE(second.count(name)) << name;
    EXPECT_TRUE(second.at(name) == bytes) << name << " differs between one and two workers";
  }

  std::istringstream lines(first.at("report.jsonl"));
  std::string line, glbs;
  int items = 0;
  while (std::getline(lines, line)) {
    const auto report = nlohmann::json::parse(line);
    EXPECT_EQ(report.at("exit_code"), 0) << line;
    ++items;
    for (const char* name : {"garment.glb", "dressed.glb"})
      glbs += " '" + (folder / "one" / report.at("sku").get<std::string>() / name).string() + "'";
  }
  EXPECT_EQ(items, 10);
  const std::string validate = "node '" + std::string(VITRINE_SOURCE_DIR) + "/tests/gltf/validate.mjs'" + glbs;
  EXPECT_EQ(std::system(validate.c_str()), 0)
      << "the Khronos validator found faults, or npm ci was not run in tests/gltf";
}
