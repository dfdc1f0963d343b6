// SPDX-License-Identifier: GPL-3.0-or-later
// vitrine measure: a tiny reference, so that the path through the program is tried and not the cloth.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "run.hpp"

namespace vitrine::test {
namespace {

const std::string tiny = " --reference-nodes 1500 --reference-residual 1e-2 --jobs 2";

std::vector<std::map<std::string, std::string>> table(const fs::path& file) {
  std::istringstream in(slurp(file));
  std::vector<std::string> names;
  std::vector<std::map<std::string, std::string>> rows;
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (const char c : line) {
      if (c == '"')
        quoted = !quoted;
      else if (c == ',' && !quoted)
        fields.emplace_back();
      else
        fields.back() += c;
    }
    if (names.empty()) {
      names = fields;
      continue;
    }
    EXPECT_EQ(fields.size(), names.size()) << line;
    rows.emplace_back();
    for (std::size_t i = 0; i < std::min(fields.size(), names.size()); ++i) rows.back()[names[i]] = fields[i];
  }
  return rows;
}

TEST(Measure, compares_the_qualities_of_a_manifest_with_a_reference_and_gives_a_refused_item_a_row) {
  const fs::path folder = scratch();
  std::ofstream(folder / "shop.csv") << "sku,garment,front,back,chest_cm,length_cm\n"
                                     << "sailor,vest," << sample << "vest-sailor-front.jpg," << sample
                                     << "vest-sailor-back.jpg,46,61\n"
                                     << "wrong,skirt," << sample << "vest-sailor-front.jpg," << sample
                                     << "vest-sailor-back.jpg,,\n";
  const fs::path out = folder / "out";
  const Outcome run = run_vitrine("measure " + (folder / "shop.csv").string() + " --out " + out.string() + tiny);
  ASSERT_EQ(run.exit_code, 0) << run.text;
  for (const char* name : {"runs.csv", "effects.csv", "references.csv", "pareto.svg", "pareto.png", "knobs.svg",
                           "summary.json", "measure.md"})
    EXPECT_GT(slurp(out / name).size(), 50u) << name;
  std::map<std::string, std::map<std::string, std::string>> sailor;
  std::string refused;
  for (auto& row : table(out / "runs.csv")) {
    EXPECT_EQ(row["source"], "shop");
    if (row["item"] == "sailor") sailor[row["setting"]] = row;
    if (row["item"] == "wrong") refused = row["status"];
  }
  EXPECT_FALSE(refused.empty());
  EXPECT_NE(refused, "OK");
  EXPECT_NE(refused, "CRASHED");
  ASSERT_EQ(sailor.size(), 3u);
  for (const char* name : {"draft", "standard", "fine"}) {
    SCOPED_TRACE(name);
    auto& row = sailor[name];
    EXPECT_EQ(row["status"], "OK");
    for (const char* figure :
         {"nodes", "cpu_ms", "sewing_ms", "peak_mb", "mean_mm", "max_mm", "hem_mm", "chest_mm", "iou"})
      EXPECT_FALSE(row[figure].empty()) << figure;
    EXPECT_LT(std::stod(row["mean_mm"]), 50);
    EXPECT_GT(std::stod(row["iou"]), 0.5);
  }
  EXPECT_GT(std::stod(sailor["fine"]["nodes"]), std::stod(sailor["standard"]["nodes"]));
  const auto references = table(out / "references.csv");
  ASSERT_EQ(references.size(), 1u);
  EXPECT_NEAR(std::stod(references[0].at("nodes")), 1500, 300);
  const auto effects = table(out / "effects.csv");
  EXPECT_GE(effects.size(), 3u);
  bool measured = false;
  for (const auto& row : effects) measured |= !row.at("change_mean_mm").empty();
  EXPECT_TRUE(measured);
  const auto summary = nlohmann::json::parse(slurp(out / "summary.json"));
  EXPECT_EQ(summary.at("bars").at("items"), 1);

  // A second run goes on from the references of the first: they keep their times, to the last digit.
  const Outcome again =
      run_vitrine("measure " + (folder / "shop.csv").string() + " --out " + out.string() + tiny + " --no-effects");
  ASSERT_EQ(again.exit_code, 0) << again.text;
  EXPECT_EQ(table(out / "references.csv").at(0).at("cpu_ms"), references[0].at("cpu_ms"));
  for (auto& row : table(out / "runs.csv"))
    if (row["item"] == "sailor") {
      EXPECT_EQ(row["mean_mm"], sailor[row["setting"]]["mean_mm"]);
    }
}

TEST(Measure, wrong_usage_is_told_with_a_remedy) {
  const fs::path folder = scratch();
  const std::string out = " --out " + (folder / "out").string(), photo = sample + "vest-sailor-front.jpg";
  const std::pair<std::string, std::string> wrong[] = {
      {"measure" + out, "nothing to measure"},
      {"measure --front " + photo + out, "garment type is missing"},
      {"measure --front " + photo + " --garment vest" + out, "back photo is missing"},
      {"measure " + sample + "manifest.csv --front " + photo + out, "exclude each other"},
      {"measure " + sample + "manifest.csv --grid huge" + out, "--grid"},
      {"measure " + sample + "manifest.csv --reference-nodes 3" + out, "--reference-nodes"},
      {"measure " + sample + "manifest.csv", "--out"},
  };
  for (const auto& [arguments, words] : wrong) {
    const Outcome run = run_vitrine(arguments);
    EXPECT_EQ(run.exit_code, 64) << arguments << "\n" << run.text;
    EXPECT_NE(run.text.find(words), std::string::npos) << run.text;
  }
  EXPECT_EQ(run_vitrine("measure " + (folder / "none.csv").string() + out).exit_code, 66);
}

}  // namespace
}  // namespace vitrine::test
