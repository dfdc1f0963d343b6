// SPDX-License-Identifier: GPL-3.0-or-later
// vitrine features: one photo to JSON, mask and picture, in the photo as given.
#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "run.hpp"

using namespace vitrine::test;
using nlohmann::json;

namespace {

const std::vector<std::string> vest_points{"neck_left",   "neck_right",   "neck_low", "shoulder_left", "shoulder_right",
                                           "armpit_left", "armpit_right", "hem_left", "hem_right"};
const std::vector<std::string> skirt_points{"waist_left", "waist_right", "waist_low", "hem_left", "hem_right"};

std::vector<std::string> sleeve_points() {
  std::vector<std::string> names = vest_points;
  for (const char* cuff : {"cuff_upper_left", "cuff_upper_right", "cuff_lower_left", "cuff_lower_right"})
    names.push_back(cuff);
  return names;
}

Outcome features(const std::string& arguments, const std::string& errors = "2>/dev/null") {
  return run_vitrine("features " + arguments, errors);
}

/// What --json prints; fails the test when standard output holds anything else.
json seen(const std::string& arguments, int exit_code = 0) {
  const Outcome run = features(arguments + " --json");
  EXPECT_EQ(run.exit_code, exit_code) << arguments;
  json report = json::parse(run.text, nullptr, false);
  EXPECT_FALSE(report.is_discarded()) << "standard output is not JSON:\n" << run.text;
  return report;
}

std::map<std::string, cv::Point2d> points_of(const json& report) {
  std::map<std::string, cv::Point2d> points;
  for (const json& f : report.at("features")) points[f.at("name")] = {f.at("x"), f.at("y")};
  return points;
}

/// A sample photo as a PNG of its own, so that no second compression comes between two runs.
fs::path edited(const std::string& name, const fs::path& folder, const std::function<void(cv::Mat&)>& edit) {
  cv::Mat photo = cv::imread(sample + name);
  edit(photo);
  const fs::path path = folder / "edited.png";
  cv::imwrite(path.string(), photo);
  return path;
}

std::set<int> values_of(const cv::Mat& mask) {
  return {mask.begin<unsigned char>(), mask.end<unsigned char>()};
}

std::string other_side(std::string name) {
  const auto left = name.find("_left"), right = name.find("_right");
  if (left != std::string::npos) return name.replace(left, 5, "_right");
  if (right != std::string::npos) return name.replace(right, 6, "_left");
  return name;
}

}  // namespace

TEST(FeaturesCommand, json_has_every_named_point_within_the_picture) {
  const std::tuple<const char*, const char*, std::vector<std::string>> items[] = {
      {"vest-terracotta", "vest", vest_points},
      {"long-sleeve-sunrise", "long_sleeve", sleeve_points()},
      {"skirt-denim", "skirt", skirt_points}};
  for (const auto& [name, garment, wanted] : items)
    for (const std::string side : {"front", "back"}) {
      const std::string photo = sample + name + "-" + side + ".jpg";
      SCOPED_TRACE(photo);
      const json report = seen("--" + side + " " + in_quotes(photo) + " --garment " + garment);
      const cv::Mat picture = cv::imread(photo);
      EXPECT_EQ(report.at("status"), "OK");
      EXPECT_EQ(report.at("side"), side);
      EXPECT_EQ(report.at("garment"), garment);
      EXPECT_EQ(report.at("size"), json({picture.cols, picture.rows}));
      EXPECT_TRUE(report.at("silhouette").at("method").is_string());
      EXPECT_TRUE(report.at("pose").is_string());
      EXPECT_LT(std::abs(report.at("tilt_deg").get<double>()), 20);
      EXPECT_TRUE(report.at("warnings").is_array());
      const auto points = points_of(report);
      EXPECT_EQ(points.size(), wanted.size());
      for (const std::string& point : wanted) {
        ASSERT_TRUE(points.count(point)) << point;
        EXPECT_TRUE(cv::Rect2d(0, 0, picture.cols, picture.rows).contains(points.at(point))) << point;
        // Sides of the picture as given, on back photos too.
        if (point.find("_left") != std::string::npos) {
          EXPECT_LT(points.at(point).x, points.at(other_side(point)).x) << point;
        }
      }
      for (const json& f : report.at("features")) {
        EXPECT_GE(f.at("confidence"), 0);
        EXPECT_LE(f.at("confidence"), 1);
        EXPECT_TRUE(std::set<std::string>({"candidate", "template", "neckline", "outline"}).count(f.at("origin")));
      }
      if (std::string(garment) != "skirt") {
        EXPECT_TRUE(report.at("neckline").at("id").is_string());
        EXPECT_TRUE(report.at("neckline").at("inside_found").is_boolean());
        EXPECT_GE(report.at("neckline").at("ratio"), 0);
      }
    }
}

TEST(FeaturesCommand, mirrored_photo_given_as_back_has_mirrored_points) {
  const fs::path folder = scratch();
  for (const auto& [photo, garment] :
       {std::pair{"skirt-garden-front.jpg", "skirt"}, {"vest-sailor-back.jpg", "vest"}}) {
    SCOPED_TRACE(photo);
    int width = 0;
    const fs::path mirrored = edited(photo, folder, [&](cv::Mat& m) {
      width = m.cols;
      cv::flip(m, m, 1);
    });
    const json plain = seen("--front " + in_quotes(sample + std::string(photo)) + " --garment " + garment);
    const json turned = seen("--back " + in_quotes(mirrored) + " --garment " + garment);
    const auto front = points_of(plain), back = points_of(turned);
    ASSERT_EQ(front.size(), back.size());
    ASSERT_GE(front.size(), 5u);
    EXPECT_DOUBLE_EQ(plain.at("tilt_deg"), -turned.at("tilt_deg").get<double>());
    for (const auto& [name, p] : front) {
      if (name.find("neck") == 0) continue;  // an inside of the back is looked for on fronts only
      ASSERT_TRUE(back.count(other_side(name))) << name;
      const cv::Point2d q = back.at(other_side(name));
      EXPECT_NEAR(width - 1 - p.x, q.x, 2) << name;
      EXPECT_NEAR(p.y, q.y, 2) << name;
    }
  }
}

TEST(FeaturesCommand, lying_photo_is_turned_upright_and_its_points_are_on_the_photo_as_given) {
  const fs::path folder = scratch();
  const auto upright = points_of(
      seen("--front " + in_quotes(edited("vest-terracotta-front.jpg", folder, [](auto&) {})) + " --garment vest"));
  for (const int turn : {cv::ROTATE_90_CLOCKWISE, cv::ROTATE_180, cv::ROTATE_90_COUNTERCLOCKWISE}) {
    SCOPED_TRACE(turn);
    cv::Size size;
    const fs::path lying = edited("vest-terracotta-front.jpg", folder, [&](cv::Mat& m) {
      size = m.size();
      cv::rotate(m, m, turn);
    });
    const auto points = points_of(seen("--front " + in_quotes(lying) + " --garment vest"));
    ASSERT_EQ(points.size(), upright.size());
    for (const auto& [name, p] : upright) {
      const cv::Point2d wanted = turn == cv::ROTATE_90_CLOCKWISE ? cv::Point2d(size.height - 1 - p.y, p.x)
                                 : turn == cv::ROTATE_180 ? cv::Point2d(size.width - 1 - p.x, size.height - 1 - p.y)
                                                          : cv::Point2d(p.y, size.width - 1 - p.x);
      EXPECT_LT(cv::norm(points.at(name) - wanted), 0.01 * size.height) << name << " left and right are the garment's";
    }
  }
}

TEST(FeaturesCommand, mask_has_the_photos_size_and_three_values) {
  const fs::path folder = scratch(), mask = folder / "mask.png";
  const std::string front = in_quotes(sample + "vest-sailor-front.jpg");
  ASSERT_EQ(features("--front " + front + " --garment vest --mask " + in_quotes(mask)).exit_code, 0);
  const cv::Mat labels = cv::imread(mask.string(), cv::IMREAD_UNCHANGED);
  const cv::Mat photo = cv::imread(sample + "vest-sailor-front.jpg");
  EXPECT_EQ(labels.type(), CV_8UC1);
  EXPECT_EQ(labels.size(), photo.size());
  EXPECT_EQ(values_of(labels), (std::set<int>{0, 128, 255}));
  // What was written can be given back.
  const json again = seen("--front " + front + " --garment vest --front-mask " + in_quotes(mask));
  EXPECT_EQ(again.at("silhouette").at("method"), "mask");
  EXPECT_EQ(points_of(again).size(), vest_points.size());
}

TEST(FeaturesCommand, back_photos_mask_lies_on_the_photo_as_given) {
  // Half of the picture is painted over, so that a mask the wrong way round would lie on nothing.
  const fs::path folder = scratch(), mask = folder / "mask.png";
  const fs::path photo = edited("skirt-denim-back.jpg", folder, [](cv::Mat& m) {
    const cv::Mat ground(m.rows, m.cols, m.type(), cv::mean(m(cv::Rect(0, 0, 20, 20))));
    cv::hconcat(m, ground, m);
  });
  ASSERT_EQ(features("--back " + in_quotes(photo) + " --garment skirt --mask " + in_quotes(mask)).exit_code, 0);
  const cv::Mat labels = cv::imread(mask.string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(labels.size(), cv::imread(photo.string()).size());
  const int half = labels.cols / 2;
  EXPECT_GT(cv::countNonZero(labels.colRange(0, half)), labels.rows * half / 4);
  EXPECT_EQ(cv::countNonZero(labels.colRange(half, labels.cols)), 0);
}

TEST(FeaturesCommand, points_and_mask_of_a_large_photo_are_in_its_own_pixels) {
  const fs::path folder = scratch(), mask = folder / "mask.png";
  const int times = 4;
  cv::Size size;
  const fs::path large = edited("skirt-denim-back.jpg", folder, [&](cv::Mat& m) {
    cv::Mat big(times * m.rows, times * m.cols, m.type());
    for (int y = 0; y < big.rows; ++y)
      for (int x = 0; x < big.cols; ++x) big.at<cv::Vec3b>(y, x) = m.at<cv::Vec3b>(y / times, x / times);
    m = big;
    size = m.size();
  });
  ASSERT_GT(size.width, 2400) << "the photo is not larger than what is worked on";
  const json report = seen("--back " + in_quotes(large) + " --garment skirt --mask " + in_quotes(mask));
  EXPECT_EQ(report.at("size"), json({size.width, size.height}));
  const cv::Mat labels = cv::imread(mask.string(), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(labels.size(), size);
  for (const int value : values_of(labels)) EXPECT_TRUE(value == 0 || value == 128 || value == 255) << value;
  const auto points = points_of(report);
  const auto small = points_of(seen("--back " + in_quotes(sample + "skirt-denim-back.jpg") + " --garment skirt"));
  ASSERT_EQ(points.size(), small.size());
  for (const auto& [name, p] : small) {
    if (name == "waist_low") continue;  // a straight waist is about as low in many places
    EXPECT_LT(cv::norm(points.at(name) - times * p), 0.01 * size.width) << name;
  }
}

TEST(FeaturesCommand, same_photo_gives_the_same_bytes_and_a_picture_to_look_at) {
  const fs::path folder = scratch();
  const std::string photo = in_quotes(sample + "vest-terracotta-back.jpg");
  std::string text[2], mask[2], overlay[2];
  for (int i = 0; i < 2; ++i) {
    const Outcome run = features("--back " + photo + " --garment vest --json --mask " + in_quotes(folder / "m.png") +
                                 " --overlay " + in_quotes(folder / "o.png"));
    ASSERT_EQ(run.exit_code, 0);
    text[i] = run.text;
    mask[i] = slurp(folder / "m.png");
    overlay[i] = slurp(folder / "o.png");
  }
  EXPECT_EQ(text[0], text[1]);
  EXPECT_TRUE(mask[0] == mask[1]);
  EXPECT_TRUE(overlay[0] == overlay[1]);
  const cv::Mat picture = cv::imread((folder / "o.png").string());
  EXPECT_GE(std::max(picture.cols, picture.rows), 1100);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2) << "a temporary file was left behind";
}

TEST(FeaturesCommand, without_json_a_table_is_printed) {
  const Outcome run = features("--front " + in_quotes(sample + "skirt-denim-front.jpg") + " --garment skirt");
  EXPECT_EQ(run.exit_code, 0);
  for (const std::string& name : skirt_points) EXPECT_NE(run.text.find(name), std::string::npos) << run.text;
}

TEST(FeaturesCommand, refusal_is_json_too_and_ends_with_the_errors_code) {
  const fs::path folder = scratch();
  const json missing = seen("--front no-such-photo.jpg --garment vest", 66);
  EXPECT_EQ(missing.at("status"), "MISSING_FILE");
  EXPECT_NE(missing.at("message").get<std::string>().find("no-such-photo.jpg"), std::string::npos);
  for (const char* key : {"stage", "remedy"}) EXPECT_FALSE(missing.at(key).get<std::string>().empty()) << key;
  EXPECT_TRUE(missing.at("features").empty());

  const json unknown = seen("--front " + in_quotes(sample + "vest-sailor-front.jpg") + " --garment kimono", 69);
  EXPECT_EQ(unknown.at("status"), "UNKNOWN_GARMENT");
  EXPECT_NE(unknown.at("remedy").get<std::string>().find("long_sleeve"), std::string::npos);

  const json other =
      seen("--front " + in_quotes(sample + "long-sleeve-sunrise-front.jpg") + " --garment skirt --mask " +
               in_quotes(folder / "mask.png") + " --overlay " + in_quotes(folder / "overlay.png"),
           65);
  EXPECT_EQ(other.at("status"), "NOT_THIS_GARMENT");
  EXPECT_EQ(other.at("stage"), "features");
  // The silhouette was found, and helps to see why.
  EXPECT_FALSE(cv::imread((folder / "mask.png").string()).empty());
  EXPECT_FALSE(cv::imread((folder / "overlay.png").string()).empty());
}

TEST(FeaturesCommand, refusal_leaves_no_picture_of_an_earlier_run) {
  const fs::path folder = scratch(), mask = folder / "mask.png", flat = folder / "flat.png";
  cv::imwrite(flat.string(), cv::Mat(300, 300, CV_8UC3, cv::Scalar(90, 90, 90)));
  std::ofstream(mask) << "an earlier run's";
  EXPECT_EQ(features("--front " + in_quotes(flat) + " --garment vest --mask " + in_quotes(mask)).exit_code, 65);
  EXPECT_FALSE(fs::exists(mask));
}

TEST(FeaturesCommand, messages_go_to_standard_error) {
  const Outcome run = features("--front no-such-photo.jpg --garment vest");
  EXPECT_EQ(run.exit_code, 66);
  EXPECT_EQ(run.text, "");
  const Outcome both = features("--front no-such-photo.jpg --garment vest", "2>&1");
  EXPECT_NE(both.text.find("no-such-photo.jpg"), std::string::npos);
  EXPECT_NE(both.text.find("remedy"), std::string::npos);
}

TEST(FeaturesCommand, usage_errors_end_64) {
  const std::string front = in_quotes(sample + "vest-sailor-front.jpg"),
                    back = in_quotes(sample + "vest-sailor-back.jpg");
  const fs::path folder = scratch(), photo = folder / "photo.jpg";
  fs::copy_file(sample + "vest-sailor-front.jpg", photo);
  for (const std::string& arguments :
       {std::string(), "--front " + front, std::string("--garment vest"),
        "--front " + front + " --back " + back + " --garment vest",
        "--front " + front + " --garment vest --back-mask m.png",
        "--back " + back + " --garment vest --front-mask m.png",
        "--front " + front + " --garment vest --no-such-option", "--front " + front + " --garment vest --mask",
        "--front " + in_quotes(photo) + " --garment vest --overlay " + in_quotes(photo),
        "--front " + front + " --garment vest --mask x.png --overlay x.png"})
    EXPECT_EQ(features(arguments).exit_code, 64) << arguments;
  EXPECT_EQ(slurp(photo), slurp(sample + "vest-sailor-front.jpg")) << "an input was overwritten";
  EXPECT_EQ(features("--help").exit_code, 0);
}

TEST(FeaturesCommand, unwritable_outputs_end_73) {
  const fs::path folder = scratch();
  std::ofstream(folder / "file") << "x";
  const std::string photo = "--front " + in_quotes(sample + "skirt-denim-front.jpg") + " --garment skirt";
  for (const char* output : {"--mask", "--overlay"}) {
    const json report = seen(photo + " " + output + " " + in_quotes(folder / "file" / "out.png"), 73);
    EXPECT_NE(report.at("status"), "OK");
  }
  EXPECT_EQ(features(photo + " --json >/dev/full").exit_code, 73);
}
