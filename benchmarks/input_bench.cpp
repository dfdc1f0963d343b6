// SPDX-License-Identifier: GPL-3.0-or-later
// vitrine-input-bench [--rows 10000,100000,1000000] [--no-pictures]: processor seconds and peak memory of reading
// made-up feeds of each kind, one line of a Markdown table each. Every reading is a process of its own, so that the
// peak is its own.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "vitrine/catalog_input.hpp"

namespace {

namespace fs = std::filesystem;

constexpr int rows_of_a_product = 4;
const char* const kinds[] = {"vest", "skirt", "long sleeved top", "mug"};

std::string address(int product, int picture) {
  const char* side[] = {"front", "back", "worn", "detail"};
  return "https://cdn.shop.example/files/2026/p" + std::to_string(product) + "_" + side[picture] + ".jpg";
}

std::string description(int product, std::size_t bytes) {
  std::string text = "<p>A garment of many words. Pit to pit: " + std::to_string(40 + product % 20) + " cm.</p>";
  while (text.size() < bytes) text += " Soft, honest cloth from a small mill, cut with care.";
  return text;
}

void shopify(std::ofstream& out, int rows, std::size_t text) {
  out << "Handle,Title,Body (HTML),Vendor,Type,Tags,Published,Option1 Name,Option1 Value,Variant SKU,Variant "
         "Price,Image "
         "Src,Image Position,Image Alt Text,Status\n";
  for (int i = 0; i < rows; ++i) {
    const int p = i / rows_of_a_product, k = i % rows_of_a_product;
    const std::string n = std::to_string(p);
    if (k == 0)
      out << "p" << n << ",\"Garment " << n << ", " << kinds[p % 4] << "\",\"" << description(p, text) << "\",Shop,"
          << kinds[p % 4] << ",\"summer, new\",TRUE,Size,S,P" << n << "-S,39.00," << address(p, k) << ",1,,active\n";
    else
      out << "p" << n << ",,,,,,,,"
          << "SMLX"[k] << ",P" << n << "-" << k << ",39.00," << address(p, k) << "," << k + 1 << ",,\n";
  }
}

void google_table(std::ofstream& out, int rows, std::size_t text) {
  out << "id\ttitle\tdescription\timage_link\tadditional_image_link\tproduct_type\tcolor\tsize\titem_group_id\n";
  for (int i = 0; i < rows; ++i) {
    const int p = i / rows_of_a_product;
    out << "P" << p << "-" << i % rows_of_a_product << "\tGarment " << p << " " << kinds[p % 4] << "\t"
        << description(p, text) << "\t" << address(p, 0) << "\t" << address(p, 1) << "," << address(p, 2) << "\t"
        << kinds[p % 4] << "\tred\t" << i % rows_of_a_product << "\tP" << p << "\n";
  }
}

void google_xml(std::ofstream& out, int rows, std::size_t text) {
  out << "<?xml version=\"1.0\"?>\n<rss version=\"2.0\" xmlns:g=\"http://base.google.com/ns/1.0\"><channel>\n";
  for (int i = 0; i < rows; ++i) {
    const int p = i / rows_of_a_product;
    out << "<item><g:id>P" << p << "-" << i % rows_of_a_product << "</g:id><title>Garment " << p << " " << kinds[p % 4]
        << "</title><description><![CDATA[" << description(p, text) << "]]></description><g:image_link>"
        << address(p, 0) << "</g:image_link><g:additional_image_link>" << address(p, 1)
        << "</g:additional_image_link><g:product_type>" << kinds[p % 4] << "</g:product_type><g:item_group_id>P" << p
        << "</g:item_group_id></item>\n";
  }
  out << "</channel></rss>\n";
}

void woocommerce(std::ofstream& out, int rows, std::size_t text) {
  out << "ID,Type,SKU,Name,Published,Description,Categories,Tags,Images,Parent\n";
  for (int i = 0; i < rows; ++i)
    out << i << ",simple,P" << i << ",Garment " << i << ",1,\"" << description(i, text) << "\"," << kinds[i % 4]
        << ",new,\"" << address(i, 0) << ", " << address(i, 1) << "\",\n";
}

void manifest(std::ofstream& out, int rows, std::size_t) {
  out << "sku,garment,front,back,mannequin\n";
  for (int i = 0; i < rows; ++i) out << "p" << i << ",vest,p" << i << "_f.jpg,p" << i << "_b.jpg,S M\n";
}

struct Case {
  const char* name;
  void (*write)(std::ofstream&, int, std::size_t);
  bool feed;
};

/// Reads in a process of its own and prints its row.
void measure(const Case& what, const fs::path& file, int rows, const std::string& image_root) {
  std::fflush(stdout);
  const pid_t child = ::fork();
  if (child != 0) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return;
  }
  vitrine::InputOptions options;
  if (what.feed) options.image_root = image_root;
  const std::clock_t start = std::clock();
  const auto input = vitrine::read_input(file.string(), options);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  std::size_t refused = 0;
  if (input)
    for (const auto& item : input->items) refused += item.refusal != nullptr;
  std::printf("| %s | %d | %.1f | %zu | %zu | %.2f | %ld |\n", what.name, rows,
              static_cast<double>(fs::file_size(file)) / 1e6, input ? input->items.size() - refused : 0, refused,
              seconds, used.ru_maxrss / 1024);
  if (!input) std::printf("  %s\n", input.error().message.c_str());
  std::fflush(stdout);
  ::_exit(0);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Processor seconds and memory of reading made-up feeds");
  std::vector<int> rows{10'000, 1'000'000};
  bool no_pictures = false;
  app.add_option("--rows", rows, "Rows of each feed")->delimiter(',');
  app.add_flag("--no-pictures", no_pictures, "Without an image root");
  CLI11_PARSE(app, argc, argv);

  std::string pattern = (fs::temp_directory_path() / "vitrine-input-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) return 73;
  const fs::path folder = pattern;
  // Pictures of the first 10,000 rows: those of more rows are refused one by one, which costs as much to find out.
  std::string image_root;
  if (!no_pictures) {
    image_root = (folder / "images").string();
    fs::create_directories(image_root);
    for (int p = 0; p < 10'000; ++p)
      for (int k = 0; k < 2; ++k) {
        const std::string url = address(p, k);
        std::ofstream(image_root + url.substr(url.rfind('/')));
      }
  }
  std::printf(
      "| feed | rows | MB | to convert | refused | s of a processor | peak MB |\n|---|---|---|---|---|---|---|\n");
  for (const int n : rows)
    for (const Case& what : {Case{"manifest, CSV", manifest, false},
                             {"Shopify, CSV", shopify, true},
                             {"Google, TSV", google_table, true},
                             {"Google, XML", google_xml, true},
                             {"WooCommerce, CSV", woocommerce, true}}) {
      const fs::path file = folder / "feed";
      // Descriptions as shops write them, as far as a feed of 256 MB has room for them.
      const std::size_t text = n <= 20'000 ? 1500 : 0;
      {
        std::ofstream out(file, std::ios::binary);
        what.write(out, n, text);
      }
      measure(what, file, n, image_root);
    }
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  return 0;
}
