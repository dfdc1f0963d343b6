// SPDX-License-Identifier: GPL-3.0-or-later
// Bad input from the command line: a clear error that names the file and the remedy, the documented exit code, nothing
// half-written.
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "run.hpp"

using namespace vitrine::test;

namespace {

std::string a_front() {
  for (const auto& entry : fs::directory_iterator(sample))
    if (entry.path().filename().string().find("front.jpg") != std::string::npos) return entry.path().string();
  return {};
}

Outcome convert(const std::string& front, const fs::path& out,
                const std::string& more = "--garment vest --mirror-back") {
  return run_vitrine("convert --quality draft --front '" + front + "' " + more + " --out '" + out.string() + "'");
}

void expect_refused(const Outcome& run, int exit_code, const std::string& named, const fs::path& out) {
  EXPECT_EQ(run.exit_code, exit_code) << run.text;
  EXPECT_NE(run.text.find(named), std::string::npos) << "the message does not name " << named << ":\n" << run.text;
  EXPECT_NE(run.text.find("remedy"), std::string::npos) << run.text;
  EXPECT_FALSE(fs::exists(out / "garment.glb"));
  EXPECT_FALSE(fs::exists(out / "preview.png"));
}

/// A PNG's first bytes that claim 30,000 x 30,000 pixels.
std::string huge_png_header() {
  const unsigned char bytes[] = {0x89, 'P',  'N',  'G', 0x0d, 0x0a, 0x1a, 0x0a, 0, 0, 0, 13, 'I', 'H', 'D', 'R', 0,
                                 0,    0x75, 0x30, 0,   0,    0x75, 0x30, 8,    2, 0, 0, 0,  0,   0,   0,   0};
  return {reinterpret_cast<const char*>(bytes), sizeof bytes};
}

}  // namespace

TEST(BadInput, missing_photo_ends_66_and_names_it) {
  const fs::path out = scratch() / "out";
  expect_refused(convert("no-such-photo.jpg", out), 66, "no-such-photo.jpg", out);
}

TEST(BadInput, empty_truncated_tiny_huge_and_foreign_files_end_65) {
  const fs::path folder = scratch(), out = folder / "out";
  const std::string whole = slurp(a_front());
  ASSERT_GT(whole.size(), 2000u);
  const std::map<std::string, std::string> files{{"empty.jpg", ""},
                                                 {"truncated.jpg", whole.substr(0, whole.size() / 3)},
                                                 {"huge.png", huge_png_header()},
                                                 {"text.jpg", "this is not a picture\n"}};
  for (const auto& [name, bytes] : files) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    expect_refused(convert((folder / name).string(), out), 65, name, out);
  }
  cv::imwrite((folder / "one.png").string(), cv::Mat(1, 1, CV_8UC3, cv::Scalar(1, 2, 3)));
  expect_refused(convert((folder / "one.png").string(), out), 65, "one.png", out);
}

TEST(BadInput, mask_of_another_size_ends_65) {
  const fs::path folder = scratch(), out = folder / "out";
  cv::imwrite((folder / "mask.png").string(), cv::Mat(50, 40, CV_8UC1, cv::Scalar(255)));
  expect_refused(
      convert(a_front(), out, "--garment vest --mirror-back --front-mask '" + (folder / "mask.png").string() + "'"), 65,
      "mask.png", out);
}

TEST(BadInput, unknown_garment_neckline_and_fabric_name_the_choices) {
  const fs::path out = scratch() / "out";
  Outcome run = convert(a_front(), out, "--garment kimono --mirror-back");
  expect_refused(run, 69, "kimono", out);
  EXPECT_NE(run.text.find("long_sleeve"), std::string::npos);
  run = convert(a_front(), out, "--garment vest --neckline neck_x --mirror-back");
  expect_refused(run, 69, "neck_x", out);
  EXPECT_NE(run.text.find("neck_v"), std::string::npos);
  expect_refused(convert(a_front(), out, "--garment vest --fabric steel --mirror-back"), 64, "steel", out);
}

TEST(BadInput, unwritable_folder_ends_73) {
  // A file where the folder should be: not writable for anybody, root included.
  const fs::path folder = scratch();
  std::ofstream(folder / "file") << "x";
  const Outcome run = convert("no-such-photo.jpg", folder / "file" / "out");
  EXPECT_EQ(run.exit_code, 73) << run.text;
}

TEST(BadInput, usage_errors_end_64) {
  EXPECT_EQ(run_vitrine("").exit_code, 64);
  EXPECT_EQ(run_vitrine("convert").exit_code, 64);
  EXPECT_EQ(run_vitrine("convert --front a.jpg --garment vest --out x").exit_code, 64);
  EXPECT_EQ(run_vitrine("convert --front a.jpg --back b.jpg --mirror-back --garment vest --out x").exit_code, 64);
  EXPECT_EQ(run_vitrine("convert --front a.jpg --mirror-back --garment vest --chest-cm -4 --out x").exit_code, 64);
  EXPECT_EQ(run_vitrine("--help").exit_code, 0);
}

TEST(BadInput, bad_mannequins_are_named) {
  const fs::path folder = scratch(), out = folder / "out";
  const std::string more = "--garment vest --mirror-back --mannequin ";
  expect_refused(convert(a_front(), out, more + "no-body.obj"), 66, "no-body.obj", out);
  std::ofstream(folder / "body.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  expect_refused(convert(a_front(), out, more + (folder / "body.obj").string()), 65, "body.obj", out);
  std::ofstream(folder / "m.json") << "{\"bust\": 20}";
  expect_refused(convert(a_front(), out, more + (folder / "m.json").string()), 65, "bust", out);
}
