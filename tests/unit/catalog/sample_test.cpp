// SPDX-License-Identifier: GPL-3.0-or-later
// The committed sample catalogue is what make-sample-catalogue writes.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "sample_items.hpp"
#include "sleeve_size.hpp"
#include "vitrine/catalog.hpp"

using namespace vitrine;
using namespace vitrine::support;
namespace fs = std::filesystem;

namespace {

const fs::path folder = fs::path(VITRINE_SOURCE_DIR) / "catalog/sample";

std::vector<std::uint8_t> bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST(SampleCatalogue, the_manifest_is_the_generators) {
  const auto bytes = bytes_of(folder / "manifest.csv");
  EXPECT_EQ(std::string(bytes.begin(), bytes.end()), sample_manifest());
}

TEST(SampleCatalogue, the_manifest_reads_without_a_warning_and_finds_its_photos) {
  std::vector<std::string> warnings;
  const auto read = read_manifest((folder / "manifest.csv").string(), &warnings);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(warnings.empty());
  ASSERT_EQ(read->size(), sample_items().size());
  std::map<std::string, int> kinds;
  for (const CatalogItem& item : *read) {
    ++kinds[item.garment];
    EXPECT_TRUE(fs::is_regular_file(item.front)) << item.front;
    EXPECT_TRUE(fs::is_regular_file(item.back)) << item.back;
    EXPECT_FALSE(item.mirror_back);
    EXPECT_TRUE(item.chest_cm && item.length_cm);
  }
  EXPECT_EQ(kinds, (std::map<std::string, int>{{"vest", 2},
                                               {"long_sleeve", 2},
                                               {"skirt", 2},
                                               {"t_shirt", 1},
                                               {"dress", 1},
                                               {"trousers", 1},
                                               {"shorts", 1}}));
}

TEST(SampleCatalogue, the_photos_are_small_enough_for_the_repository) {
  std::uintmax_t total = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    EXPECT_LT(entry.file_size(), 250'000u) << entry.path();
    total += entry.file_size();
  }
  EXPECT_LT(total, 4'000'000u);
}

TEST(SampleCatalogue, the_committed_photos_are_what_the_generator_draws) {
  for (const SampleItem& item : sample_items())
    for (const bool back : {false, true}) {
      const std::string name = item.sku + (back ? "-back.jpg" : "-front.jpg");
      SCOPED_TRACE(name);
      const auto committed = bytes_of(folder / name);
      ASSERT_FALSE(committed.empty());
      const cv::Mat is = cv::imdecode(committed, cv::IMREAD_COLOR);
      const cv::Mat ought =
          cv::imdecode(to_jpeg(make_photo(back ? back_of(item.front) : item.front).rgb), cv::IMREAD_COLOR);
      ASSERT_EQ(is.size(), ought.size());
      // Pixels, not bytes: JPEG libraries and the last bit of sin() and pow() differ between versions.
      cv::Mat difference;
      cv::absdiff(is, ought, difference);
      const cv::Scalar mean = cv::mean(difference);
      for (int c = 0; c < 3; ++c) EXPECT_LT(mean[c], 0.6);
      EXPECT_LT(cv::countNonZero(difference.reshape(1) > 24), static_cast<int>(difference.total() * 3 / 2000));
    }
}

TEST(SampleCatalogue, its_long_sleeves_have_the_size_that_their_chest_asks_for) {
  for (const SampleItem& item : sample_items()) {
    if (item.front.garment != GarmentKind::long_sleeve) continue;
    for (const bool back : {false, true})
      for (const SleeveSize& sleeve : sleeves_of(make_photo(back ? back_of(item.front) : item.front))) {
        SCOPED_TRACE(item.sku + (back ? " back" : " front"));
        EXPECT_NEAR(sleeve.armpit, 17.5, 1);
        EXPECT_NEAR(sleeve.elbow, 13.1, 1);
        EXPECT_NEAR(sleeve.cuff, 9.8, 0.5);
        EXPECT_NEAR(sleeve.under, 43.5, 2);
        EXPECT_NEAR(sleeve.upper, 60, 2);
      }
  }
}

TEST(SampleCatalogue, each_garment_stands_out_from_its_board) {
  for (const SampleItem& item : sample_items()) EXPECT_GE(contrast(item.front), 60) << item.sku;
}
