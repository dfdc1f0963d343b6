// SPDX-License-Identifier: GPL-3.0-or-later
// vitrine mannequin: files, exit codes, warnings and refusals.
#include <cmath>
#include <nlohmann/json.hpp>

#include "run.hpp"

using namespace vitrine::test;
using nlohmann::json;

namespace {

json usual() {
  return {{"sex", "woman"}, {"height", 1680},    {"bust", 900}, {"under_bust", 770}, {"waist", 745},
          {"hip", 980},     {"inside_leg", 805}, {"arm", 560},  {"neck_base", 362}};
}

Outcome measured(const json& m, const fs::path& folder) {
  std::ofstream(folder / "m.json") << m.dump();
  return run_vitrine("mannequin --measurements " + in_quotes(folder / "m.json") + " --out " +
                     in_quotes(folder / "out"));
}

}  // namespace

TEST(MannequinCommand, writes_mesh_picture_and_measurements_of_a_preset) {
  const fs::path out = scratch() / "new" / "folder";
  const Outcome run = run_vitrine("mannequin --preset woman-m --out " + in_quotes(out));
  ASSERT_EQ(run.exit_code, 0) << run.text;
  EXPECT_EQ(slurp(out / "mannequin.glb").substr(0, 4), "glTF");
  EXPECT_EQ(slurp(out / "preview.png").substr(1, 3), "PNG");
  const json report = json::parse(slurp(out / "measurements.json"));
  const json asked = usual();
  for (const auto& [name, value] : asked.items()) {
    if (name == "sex") continue;
    const json& row = report.at("measurements").at(name);
    EXPECT_EQ(row.at("asked"), value) << name;
    EXPECT_NEAR(row.at("measured").get<double>(), value.get<double>(), 2) << name;
    EXPECT_EQ(row.at("level"), row.at("point").at(1)) << name;
  }
  for (const auto& entry : fs::directory_iterator(out))
    EXPECT_EQ(entry.path().filename().string().find("tmp"), std::string::npos);
}

TEST(MannequinCommand, gives_the_same_bytes_twice_and_from_a_file) {
  const fs::path folder = scratch();
  ASSERT_EQ(run_vitrine("mannequin --preset woman-m --out " + in_quotes(folder / "a")).exit_code, 0);
  ASSERT_EQ(measured(usual(), folder).exit_code, 0);
  for (const char* name : {"mannequin.glb", "preview.png", "measurements.json"})
    EXPECT_EQ(slurp(folder / "a" / name), slurp(folder / "out" / name)) << name;
}

TEST(MannequinCommand, warns_of_the_unusual_and_refuses_the_impossible_with_its_range) {
  const fs::path folder = scratch();
  json m = usual();
  m["neck_base"] = 450;
  Outcome run = measured(m, folder);
  EXPECT_EQ(run.exit_code, 0) << run.text;
  EXPECT_NE(run.text.find("warning: neck_base is 450 mm"), std::string::npos) << run.text;
  m["neck_base"] = 900;
  fs::remove_all(folder / "out");
  run = measured(m, folder);
  EXPECT_EQ(run.exit_code, 65);
  EXPECT_NE(run.text.find("neck_base of 900 mm is outside 300 to 560 mm"), std::string::npos) << run.text;
  EXPECT_FALSE(fs::exists(folder / "out" / "mannequin.glb"));
}

TEST(MannequinCommand, names_the_measurement_that_a_file_lacks) {
  json m = usual();
  m.erase("arm");
  const Outcome run = measured(m, scratch());
  EXPECT_EQ(run.exit_code, 65);
  EXPECT_NE(run.text.find("\"arm\" is missing"), std::string::npos) << run.text;
}

TEST(MannequinCommand, refuses_broken_measurement_files_and_writes_nothing) {
  const fs::path folder = scratch();
  const auto refused = [&](const std::string& text, const std::string& reason) {
    std::ofstream(folder / "m.json", std::ios::binary) << text;
    const Outcome run =
        run_vitrine("mannequin --measurements " + in_quotes(folder / "m.json") + " --out " + in_quotes(folder / "out"));
    EXPECT_EQ(run.exit_code, 65) << text;
    EXPECT_NE(run.text.find(reason), std::string::npos) << run.text;
    EXPECT_FALSE(fs::exists(folder / "out")) << text;
  };
  const auto with = [](const char* name, const json& value) {
    json m = usual();
    m[name] = value;
    return m.dump();
  };
  refused("", "not a JSON object");
  refused("[]", "not a JSON object");
  refused(std::string(100'000, '['), "not a JSON object");
  refused(usual().dump().substr(0, 40), "not a JSON object");
  refused("{\"sex\":\"woman\",\"height\":NaN}", "not a JSON object");
  refused(with("arm", "long"), "\"arm\" is not a number");
  refused(with("arm", nullptr), "\"arm\" is not a number");
  refused(with("arm", true), "\"arm\" is not a number");
  refused(with("sex", 3), "\"sex\" is not a text");
  refused(with("sex", "robot"), "\"robot\" is not one of woman, man");
  refused(with("shoe", 39), "unknown measurement \"shoe\"");
  refused(with("arm", -5), "arm of -5 mm is outside");
  // Metres for millimetres: the digits show it.
  refused(with("height", 1.68), "height of 1.68 mm is outside 1400 to 2100 mm");
  refused(with("height", 1e300), "height of 1e+300 mm is outside 1400 to 2100 mm");
}

TEST(MannequinCommand, measures_its_own_mesh_when_that_is_imported) {
  const fs::path folder = scratch();
  ASSERT_EQ(run_vitrine("mannequin --preset man-m --out " + in_quotes(folder / "built")).exit_code, 0);
  const Outcome run = run_vitrine("mannequin --import " + in_quotes(folder / "built" / "mannequin.glb") + " --out " +
                                  in_quotes(folder / "found"));
  ASSERT_EQ(run.exit_code, 0) << run.text;
  const json built = json::parse(slurp(folder / "built" / "measurements.json")).at("measurements");
  const json found = json::parse(slurp(folder / "found" / "measurements.json")).at("measurements");
  EXPECT_FALSE(found.at("hip").contains("asked"));
  for (const char* name : {"height", "hip", "inside_leg"})
    EXPECT_NEAR(found.at(name).at("measured").get<double>(), built.at(name).at("measured").get<double>(), 10) << name;
}

TEST(MannequinCommand, tells_usage_missing_and_unwritable_apart) {
  const fs::path folder = scratch();
  const std::string out = " --out " + in_quotes(folder / "out");
  EXPECT_EQ(run_vitrine("mannequin" + out).exit_code, 64);
  EXPECT_EQ(run_vitrine("mannequin --preset woman-m").exit_code, 64);
  EXPECT_EQ(run_vitrine("mannequin --preset woman-m --import x.obj" + out).exit_code, 64);
  EXPECT_EQ(run_vitrine("mannequin --preset giant" + out).exit_code, 64);
  EXPECT_EQ(run_vitrine("mannequin --import /no/such/body.obj" + out).exit_code, 66);
  EXPECT_EQ(run_vitrine("mannequin --measurements /no/such/m.json" + out).exit_code, 66);
  std::ofstream(folder / "file") << "x";
  EXPECT_EQ(run_vitrine("mannequin --preset woman-m --out " + in_quotes(folder / "file" / "out")).exit_code, 73);
}

TEST(MannequinCache, gives_the_same_garment_from_a_fresh_a_filled_and_a_damaged_cache) {
  const fs::path folder = scratch(), sample = fs::path(VITRINE_SOURCE_DIR) / "catalog" / "sample";
  const auto convert = [&](const std::string& out, const std::string& options) {
    const Outcome run =
        run_vitrine("convert --garment vest --quality draft --mannequin woman-l --front " +
                    in_quotes(sample / "vest-sailor-front.jpg") + " --back " +
                    in_quotes(sample / "vest-sailor-back.jpg") + " --out " + in_quotes(folder / out) + " " + options);
    EXPECT_EQ(run.exit_code, 0) << run.text;
    return slurp(folder / out / "garment.glb");
  };
  const std::string plain = convert("plain", "");
  const fs::path cache = folder / "cache";
  const std::string with_cache = "--cache " + in_quotes(cache);
  EXPECT_EQ(convert("fresh", with_cache), plain);
  ASSERT_EQ(std::distance(fs::directory_iterator(cache), fs::directory_iterator()), 1);
  const fs::path file = fs::directory_iterator(cache)->path();
  const std::string kept = slurp(file);
  EXPECT_EQ(convert("filled", with_cache), plain);
  // One flipped bit in the values, a cut file, a header that claims more than there is, and one that lies elsewhere.
  for (int damage = 0; damage < 4; ++damage) {
    std::string bytes = kept;
    if (damage == 0) bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
    if (damage == 1) bytes.resize(bytes.size() / 3);
    if (damage == 2) bytes[59] = 0x7f;
    if (damage == 3) bytes[30] = static_cast<char>(bytes[30] ^ 1);  // of the grid's origin
    std::ofstream(file, std::ios::binary) << bytes;
    EXPECT_EQ(convert("damaged", with_cache), plain) << damage;
    EXPECT_EQ(slurp(file), kept) << damage;
  }
}

TEST(MannequinCache, names_an_unknown_preset_and_a_folder_that_cannot_be_written) {
  const fs::path folder = scratch(), sample = fs::path(VITRINE_SOURCE_DIR) / "catalog" / "sample";
  const std::string vest = "convert --garment vest --quality draft --mirror-back --front " +
                           in_quotes(sample / "vest-sailor-front.jpg") + " --out " + in_quotes(folder / "out");
  Outcome run = run_vitrine(vest + " --mannequin woman-xxxl");
  EXPECT_EQ(run.exit_code, 64);
  EXPECT_NE(run.text.find("woman-xxxl"), std::string::npos) << run.text;
  std::ofstream(folder / "file") << "not a folder";
  run = run_vitrine(vest + " --cache " + in_quotes(folder / "file"));
  EXPECT_EQ(run.exit_code, 73) << run.text;
}
