// SPDX-License-Identifier: GPL-3.0-or-later
// What a conversion writes for a shop: names, figures and pictures in the files, and what a buyer's browser makes of
// them.
#include <openssl/evp.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "run.hpp"

using namespace vitrine::test;

namespace {

const std::string vest = "convert --quality draft --front '" + sample + "vest-sailor-front.jpg' --back '" + sample +
                         "vest-sailor-back.jpg' --garment vest --chest-cm 46 ";

nlohmann::json gltf_of(const fs::path& glb) {
  const std::string bytes = slurp(glb);
  std::uint32_t size = 0;
  if (bytes.size() < 20) return {};
  std::memcpy(&size, bytes.data() + 12, 4);
  return nlohmann::json::parse(bytes.substr(20, size));
}

std::string sha256(const std::string& text) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned size = 0;
  EVP_Digest(text.data(), text.size(), digest, &size, EVP_sha256(), nullptr);
  std::string hex;
  for (unsigned i = 0; i < size; ++i) {
    hex += "0123456789abcdef"[digest[i] >> 4];
    hex += "0123456789abcdef"[digest[i] & 15];
  }
  return hex;
}

}  // namespace

TEST(Files, carry_sku_measurements_copyright_and_the_reports_hash) {
  const fs::path out = scratch() / "out";
  const Outcome run = run_vitrine(vest + "--name 12-Sailor --copyright 'A shop' --out '" + out.string() + "'");
  ASSERT_EQ(run.exit_code, 0) << run.text;
  const auto gltf = gltf_of(out / "dressed.glb");
  EXPECT_EQ(gltf.at("asset").at("copyright"), "A shop");
  EXPECT_EQ(gltf["asset"].at("generator").get<std::string>().rfind("Vitrine", 0), 0u);
  EXPECT_EQ(gltf.at("nodes").at(0).at("name"), "garment_12-sailor");
  EXPECT_EQ(gltf["nodes"].at(1).at("name"), "mannequin");
  const auto& extras = gltf["asset"].at("extras");
  EXPECT_EQ(extras.at("sku"), "12-Sailor");
  EXPECT_NEAR(extras.at("flat_mm").at("width").get<double>(), 460, 5);
  EXPECT_NEAR(extras.at("mannequin_mm").at("height").get<double>(), 1720, 2);

  // What garment.glb was draped on can be told without the body in it.
  const auto alone = gltf_of(out / "garment.glb").at("asset").at("extras");
  EXPECT_EQ(extras.at("mannequin_sha256").get<std::string>().size(), 64u);
  EXPECT_EQ(alone.at("mannequin_sha256"), extras["mannequin_sha256"]);

  auto report = nlohmann::ordered_json::parse(slurp(out / "report.json"));
  for (const char* later : {"status", "error", "commerce", "ms"}) report.erase(later);
  EXPECT_EQ(extras.at("report_sha256"), sha256(report.dump()));
}

TEST(Files, are_held_against_what_shops_ask_and_a_sample_fails_in_nothing) {
  const fs::path out = scratch() / "out";
  ASSERT_EQ(run_vitrine(vest + "--out '" + out.string() + "'").exit_code, 0);
  const auto report = nlohmann::json::parse(slurp(out / "report.json"));
  for (const char* file : {"garment.glb", "dressed.glb"}) {
    const auto& list = report.at("commerce").at(file);
    EXPECT_GE(list.size(), 18u);
    for (const auto& finding : list) EXPECT_NE(finding.at("verdict"), "fail") << file << ": " << finding.dump();
  }
  EXPECT_LE(fs::file_size(out / "garment.glb"), 1'000'000u);
  EXPECT_LE(fs::file_size(out / "dressed.glb"), 3'000'000u);
}

TEST(Files, come_in_the_formats_and_pictures_that_were_asked_for) {
  const fs::path out = scratch() / "out";
  const Outcome run = run_vitrine(vest +
                                  "--format obj,ply --compress --texture-size 1024 --views front,detail --turntable 4 "
                                  "--picture png --picture-size 160x200 --ground alpha --out '" +
                                  out.string() + "'");
  ASSERT_EQ(run.exit_code, 0) << run.text;
  for (const char* name : {"garment.obj", "garment.mtl", "garment_texture.png", "garment.ply"})
    EXPECT_GT(fs::file_size(out / name), 50u) << name;
  EXPECT_LE(cv::imread((out / "garment_texture.png").string()).cols, 1024);
  EXPECT_EQ(gltf_of(out / "garment-page.glb").at("extensionsRequired").at(0), "EXT_meshopt_compression");
  EXPECT_LT(fs::file_size(out / "dressed-page.glb"), fs::file_size(out / "dressed.glb"));
  for (const char* name : {"front.png", "detail.png"}) {
    const cv::Mat picture = cv::imread((out / name).string(), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(picture.size(), cv::Size(160, 200)) << name;
    EXPECT_EQ(picture.channels(), 4);
  }
  EXPECT_EQ(cv::imread((out / "turntable.png").string()).size(), cv::Size(4 * 80, 100));
}

TEST(Files, options_that_contradict_each_other_end_64_before_anything_is_written) {
  const fs::path out = scratch() / "out";
  const std::string to = " --out '" + out.string() + "'";
  for (const char* bad :
       {"--views front --picture jpeg --ground alpha", "--picture-size 800", "--picture-size 800x1000x",
        "--turntable 72", "--views side", "--texture-size 1000", "--format stl"}) {
    const Outcome run = run_vitrine(vest + bad + to);
    EXPECT_EQ(run.exit_code, 64) << bad << ": " << run.text;
    EXPECT_FALSE(fs::exists(out / "garment.glb"));
  }
}

TEST(Files, a_borrowed_back_is_said_and_its_picture_is_not_the_front) {
  const fs::path out = scratch() / "out";
  const Outcome run =
      run_vitrine("convert --quality draft --front '" + sample +
                  "long-sleeve-sunrise-front.jpg' --mirror-back --garment long_sleeve --out '" + out.string() + "'");
  ASSERT_EQ(run.exit_code, 0) << run.text;
  const auto report = nlohmann::json::parse(slurp(out / "report.json"));
  const auto warnings = report.at("warnings").get<std::vector<std::string>>();
  EXPECT_NE(std::find(warnings.begin(), warnings.end(), "MIRRORED_BACK"), warnings.end());
  EXPECT_NE(std::find(warnings.begin(), warnings.end(), "PRINT_TAKEN_OFF_BACK"), warnings.end());
  EXPECT_GT(report.at("texture").at("back").at("print_taken_off_share").get<double>(), 0.01);
}

TEST(Viewer, opens_a_dressed_sample_from_disk_right_way_up_in_its_size_and_asks_nobody) {
  const fs::path out = scratch() / "out";
  ASSERT_EQ(run_vitrine(vest + "--out '" + out.string() + "'").exit_code, 0);
  const std::string view = "node '" + std::string(VITRINE_SOURCE_DIR) + "/tests/viewer/view.mjs' '" +
                           (out / "garment.glb").string() + "' '" + (out / "dressed.glb").string() + "'";
  EXPECT_EQ(std::system(view.c_str()), 0)
      << "model-viewer found faults, chromium is missing, or npm ci was not run in tests/viewer";
}
