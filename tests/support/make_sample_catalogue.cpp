// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the sample catalogue: make-sample-catalogue FOLDER
#include <filesystem>
#include <fstream>
#include <iostream>

#include "sample_items.hpp"

int main(int argc, char** argv) {
  using namespace vitrine::support;
  if (argc != 2) {
    std::cerr << "usage: make-sample-catalogue FOLDER\n";
    return 64;
  }
  const std::filesystem::path folder(argv[1]);
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  const auto write = [&](const std::string& name, const char* data, std::size_t size) {
    std::ofstream file(folder / name, std::ios::binary);
    file.write(data, static_cast<std::streamsize>(size));
    file.close();
    if (!file) {
      std::cerr << "make-sample-catalogue: cannot write " << (folder / name).string() << "\n";
      return false;
    }
    std::cout << name << " " << size << "\n";
    return true;
  };
  for (const SampleItem& item : sample_items())
    for (const bool back : {false, true}) {
      const auto file = to_jpeg(make_photo(back ? back_of(item.front) : item.front).rgb);
      if (!write(item.sku + (back ? "-back.jpg" : "-front.jpg"), reinterpret_cast<const char*>(file.data()),
                 file.size()))
        return 73;
    }
  const std::string manifest = sample_manifest();
  return write("manifest.csv", manifest.data(), manifest.size()) ? 0 : 73;
}
