// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a catalogue of any size, for benchmarks and cluster tests: make-catalogue N FOLDER [FIRST]
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <opencv2/core/utility.hpp>
#include <thread>
#include <vector>

#include "sample_items.hpp"

int main(int argc, char** argv) {
  using namespace vitrine::support;
  const int count = argc >= 3 ? std::atoi(argv[1]) : 0;
  const int first = argc == 4 ? std::atoi(argv[3]) : 0;
  if ((argc != 3 && argc != 4) || count < 1 || count > 1'000'000 || first < 0) {
    std::cerr << "usage: make-catalogue N FOLDER [FIRST], N from 1 to 1,000,000\n";
    return 64;
  }
  const std::filesystem::path folder(argv[2]);
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  const auto write = [&](const std::string& name, const char* data, std::size_t size) {
    std::ofstream file(folder / name, std::ios::binary);
    file.write(data, static_cast<std::streamsize>(size));
    file.close();
    if (!file) std::cerr << "make-catalogue: cannot write " << (folder / name).string() << "\n";
    return static_cast<bool>(file);
  };
  const GarmentKind kinds[] = {GarmentKind::vest, GarmentKind::long_sleeve, GarmentKind::skirt};
  const char* names[] = {"vest", "long_sleeve", "skirt"};
  // An item depends on its number alone, so that it does not matter which thread makes it.
  std::vector<std::string> rows(static_cast<std::size_t>(count));
  std::atomic<int> next{0};
  std::atomic<bool> failed_to_write{false};
  const auto make = [&] {
    for (int i = next++; i < count && !failed_to_write; i = next++) {
      const int kind = (first + i) % 3;
      PhotoSpec front = random_spec(static_cast<std::uint32_t>(first + i + 1), kinds[kind]);
      // As large as a small shop's photos, so that a picture costs what a picture costs.
      front.width *= 2;
      front.height *= 2;
      std::string number = std::to_string(first + i);
      number.insert(0, 6 - std::min<std::size_t>(6, number.size()), '0');
      const std::string sku = std::string(names[kind]) + "-" + number;
      for (const bool back : {false, true}) {
        const auto file = to_jpeg(make_photo(back ? back_of(front) : front).rgb);
        if (!write(sku + (back ? "-back.jpg" : "-front.jpg"), reinterpret_cast<const char*>(file.data()), file.size()))
          failed_to_write = true;
      }
      rows[static_cast<std::size_t>(i)] = sku + "," + names[kind] + "," + sku + "-front.jpg," + sku + "-back.jpg," +
                                          std::to_string(front.chest) + "," + std::to_string(front.length) + "\n";
    }
  };
  cv::setNumThreads(1);  // the items are what is shared out
  std::vector<std::thread> threads;
  for (unsigned t = 1; t < std::max(1u, std::thread::hardware_concurrency()); ++t) threads.emplace_back(make);
  make();
  for (std::thread& thread : threads) thread.join();
  if (failed_to_write) return 73;
  std::string manifest = "sku,garment,front,back,chest_cm,length_cm\n";
  for (const std::string& row : rows) manifest += row;
  return write("manifest.csv", manifest.data(), manifest.size()) ? 0 : 73;
}
