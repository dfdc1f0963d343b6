// SPDX-License-Identifier: GPL-3.0-or-later
// --max-error and --max-time as a user asks for them.
#include <nlohmann/json.hpp>

#include "run.hpp"

using namespace vitrine::test;

namespace {

const std::string sailor = "convert --front '" + sample + "vest-sailor-front.jpg' --back '" + sample +
                           "vest-sailor-back.jpg' --garment vest --chest-cm 46 ";

struct Made {
  Outcome run;
  nlohmann::json report;
};

Made make(const std::string& options, const fs::path& out) {
  Made made{run_vitrine(sailor + options + " --out '" + out.string() + "'"), {}};
  if (fs::exists(out / "report.json")) made.report = nlohmann::json::parse(slurp(out / "report.json"));
  return made;
}

bool warned(const nlohmann::json& report, const std::string& code) {
  for (const auto& warning : report.at("warnings"))
    if (warning.get<std::string>().rfind(code, 0) == 0) return true;
  return false;
}

}  // namespace

TEST(Budget, of_no_number_above_zero_is_a_usage_error) {
  for (const char* option : {"--max-error", "--max-time", "--work-rate"})
    for (const char* value : {"0", "-3", "nan", "inf", "much"}) {
      const fs::path out = scratch() / "out";
      const Made made = make(std::string(option) + "=" + value, out);
      EXPECT_EQ(made.run.exit_code, 64) << option << " " << value << "\n" << made.run.text;
      EXPECT_NE(made.run.text.find(option), std::string::npos) << made.run.text;
      EXPECT_FALSE(fs::exists(out));
    }
  EXPECT_EQ(make("--max-error 3 --spring-k 1000", scratch() / "out").run.exit_code, 64);
}

TEST(Budget, asked_estimated_and_spent_are_in_the_report_and_on_the_console) {
  const Made made = make("--max-error 1000 --max-time 1e6", scratch() / "out");
  ASSERT_EQ(made.run.exit_code, 0) << made.run.text;
  const auto& b = made.report.at("budget");
  EXPECT_EQ(b.at("asked_error_mm"), 1000);
  EXPECT_EQ(b.at("asked_time_s"), 1e6);
  EXPECT_EQ(b.at("levels"), 1) << "a metre is met by a draft";
  EXPECT_EQ(b.at("ended_by"), "error");
  EXPECT_TRUE(b.at("met").get<bool>());
  EXPECT_GT(b.at("estimated_error_mm").get<double>(), 0);
  EXPECT_NEAR(b.at("spent_s").get<double>(),
              b.at("work_units").get<double>() / b.at("work_units_per_second").get<double>(), 1e-9);
  EXPECT_NE(made.run.text.find("asked 1000 mm and 1e+06 s; estimated"), std::string::npos) << made.run.text;
  EXPECT_NE(made.run.text.find("spent"), std::string::npos);
}

TEST(Budget, that_cannot_be_met_is_told_and_the_files_are_written) {
  const fs::path out = scratch() / "out";
  const Made error = make("--max-error 0.01 --quality draft", out);
  ASSERT_EQ(error.run.exit_code, 0) << error.run.text;
  EXPECT_TRUE(warned(error.report, "MAX_ERROR_NOT_MET"));
  EXPECT_FALSE(error.report.at("budget").at("met").get<bool>());
  EXPECT_EQ(error.report["budget"].at("ended_by"), "quality");
  EXPECT_TRUE(fs::exists(out / "garment.glb"));

  const Made time = make("--max-time 0.01", out);
  ASSERT_EQ(time.run.exit_code, 0) << time.run.text;
  EXPECT_TRUE(warned(time.report, "MAX_TIME_NOT_MET"));
  EXPECT_FALSE(time.report.at("budget").at("met").get<bool>());
  EXPECT_EQ(time.report["budget"].at("ended_by"), "time");
  EXPECT_LE(time.report.at("drape").at("residual").get<double>(), 1.05e-2);
  EXPECT_TRUE(fs::exists(out / "dressed.glb"));
}

TEST(Budget, gives_the_same_bytes_twice) {
  for (const char* options : {"--max-error 4", "--max-time 1.2"}) {
    const fs::path a = scratch() / "a", b = a.parent_path() / "b";
    ASSERT_EQ(make(options, a).run.exit_code, 0);
    ASSERT_EQ(make(options, b).run.exit_code, 0);
    for (const char* file : {"garment.glb", "dressed.glb", "preview.png"})
      EXPECT_EQ(slurp(a / file), slurp(b / file)) << options << " " << file;
  }
}

TEST(Budget, a_catalogue_makes_its_items_anew_when_another_one_is_asked_for) {
  const fs::path out = scratch() / "out", manifest = out.parent_path() / "shop.csv";
  std::ofstream(manifest) << "sku,garment,front,back,chest_cm\nv,vest," << sample << "vest-sailor-front.jpg," << sample
                          << "vest-sailor-back.jpg,46\n";
  const auto night = [&](const std::string& options) {
    return run_vitrine("catalog run '" + manifest.string() + "' --out '" + out.string() + "' --progress none " +
                       options);
  };
  ASSERT_EQ(night("--max-error 50").exit_code, 0);
  const auto line = nlohmann::json::parse(slurp(out / "report.jsonl"));
  EXPECT_EQ(line.dump().find("\"budget\"") != std::string::npos, true) << line.dump();
  EXPECT_NE(line.dump().find("\"asked_error_mm\":50"), std::string::npos) << line.dump();
  EXPECT_NE(night("--max-error 50").text.find("1 unchanged"), std::string::npos);
  EXPECT_NE(night("--max-error 49").text.find("0 unchanged"), std::string::npos);
  EXPECT_EQ(night("--max-time nan").exit_code, 64);
}
