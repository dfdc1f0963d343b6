// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "vitrine/photo.hpp"
#include "vitrine/silhouette.hpp"

namespace vitrine {
namespace {

const std::filesystem::path photos = std::filesystem::path(VITRINE_SOURCE_DIR) / ".." / "shared" / "photos";

struct Row {
  std::string file, ground;
};

std::vector<Row> index_rows() {
  std::vector<Row> rows;
  std::ifstream in(photos / "index.tsv");
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    Row r;
    std::string skipped;
    std::getline(cells, r.file, '\t');
    for (int k = 0; k < 3; ++k) std::getline(cells, skipped, '\t');
    std::getline(cells, r.ground, '\t');
    rows.push_back(r);
  }
  return rows;
}

double overlap(const Image& found, const Image& truth) {
  long both = 0, any = 0;
  for (std::size_t i = 0; i < truth.data.size(); ++i) {
    both += found.data[i] > 0 && truth.data[i] > 0;
    any += found.data[i] > 0 || truth.data[i] > 0;
  }
  return any ? static_cast<double>(both) / static_cast<double>(any) : 0;
}

TEST(RealSilhouettes, noGarmentIsSilentlyCutWrong) {
  if (!std::filesystem::exists(photos / "index.tsv")) GTEST_SKIP() << "the collection of real photos is not here";
  std::map<bool, std::pair<double, int>> mean;  // by "plain board"
  int ran = 0, refused = 0;
  std::printf("%-26s %-12s %-7s %6s %6s\n", "photo", "ground", "method", "IoU", "CPU s");
  for (const Row& row : index_rows()) {
    const auto name = std::filesystem::path(row.file);
    const std::string mask = (photos / (name.stem().string() + ".mask.png")).string();
    auto photo = load_photo((photos / name).string(), mask);
    ASSERT_TRUE(photo) << photo.error().message;
    const Image truth = photo->mask;
    photo->mask = {};  // the truth is for the scorer only
    const std::clock_t start = std::clock();
    const auto found = find_silhouette(*photo);
    const double cpu = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    ++ran;
    if (!found) {
      ++refused;
      std::printf("%-26s %-12s refused %s %6.2f\n", row.file.c_str(), row.ground.c_str(), found.error().code.c_str(),
                  cpu);
      continue;
    }
    const double iou = overlap(found->labels, truth);
    std::printf("%-26s %-12s %-7s %.4f %6.2f\n", row.file.c_str(), row.ground.c_str(), found->method.c_str(), iou, cpu);
    EXPECT_GE(iou, 0.90) << row.file << " is wrong and nobody is told";
    auto& [sum, n] = mean[row.ground.starts_with("plain")];
    sum += iou;
    ++n;
  }
  ASSERT_GT(ran, 0);
  std::printf("%d photos ran, %d refused; mean IoU plain %.4f, other %.4f\n", ran, refused,
              mean[true].first / mean[true].second, mean[false].first / mean[false].second);
  EXPECT_LE(refused, ran / 10);
  EXPECT_GE(mean[true].first / mean[true].second, 0.98);
  EXPECT_GE(mean[false].first / mean[false].second, 0.965);
}

}  // namespace
}  // namespace vitrine
