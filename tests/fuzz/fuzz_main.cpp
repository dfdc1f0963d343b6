// SPDX-License-Identifier: GPL-3.0-or-later
// A mutation harness that needs no particular compiler. Input number n of a seed depends on these two alone, so what is
// printed when it fails is all that is needed to see it again.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "check_input.hpp"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/common_interface_defs.h>
#endif

namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_size = 16'384;

unsigned long long current_run = 0, current_seed = 0;
std::string current_text;

void say_where() {
  std::fprintf(stderr, "\nfuzz_input: failed; to see it again: --seed %llu --first %llu --runs 1 [--keep FILE]\n",
               current_seed, current_run);
}
void on_signal(int signal) {
  say_where();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// Pieces that readers of such texts trip over.
const std::vector<std::string> pieces = {"../",
                                         "..\\",
                                         "%2e%2e%2f",
                                         "/etc/passwd",
                                         "file:///",
                                         "https://x.example/",
                                         "leak.jpg",
                                         "out/b.jpg",
                                         "up/secret.jpg",
                                         "\"",
                                         "\"\"",
                                         "\",\"",
                                         ",",
                                         ";",
                                         "\t",
                                         "\n",
                                         "\r",
                                         "\r\n",
                                         std::string(1, '\0'),
                                         "\xEF\xBB\xBF",
                                         "\xFF",
                                         "\xC3",
                                         "\xED\xA0\x80",
                                         "\xF4\x90\x80\x80",
                                         "<![CDATA[",
                                         "]]>",
                                         "<!DOCTYPE x [<!ENTITY a \"b\">]>",
                                         "&a;",
                                         "&#0;",
                                         "&#x41;",
                                         "<g:id>",
                                         "</g:id>",
                                         "<item>",
                                         "</item>",
                                         "<!--",
                                         "-->",
                                         "<?xml version=\"1.0\" encoding=\"UTF-16\"?>",
                                         "{",
                                         "}",
                                         "[",
                                         "]",
                                         ":",
                                         "null",
                                         "true",
                                         "1e999",
                                         "-0",
                                         "1e-7",
                                         "99999999999999999999",
                                         "\\u0000",
                                         "\\ud800",
                                         "sku",
                                         "garment",
                                         "front",
                                         "back",
                                         "Handle",
                                         "Image Src",
                                         "id",
                                         "image_link",
                                         "Images",
                                         "Parent",
                                         "id:201",
                                         "_front",
                                         "_back",
                                         "-1",
                                         "-x0123456789abcdef",
                                         "report.jsonl",
                                         ".",
                                         "-",
                                         " ",
                                         "%",
                                         "?",
                                         "#",
                                         "yes",
                                         "XS S M",
                                         "S S",
                                         "Pit to pit: 46 cm"};

class Mutator {
 public:
  Mutator(const std::vector<std::string>& seeds, unsigned long long seed, unsigned long long run)
      : seeds_(seeds), random_(seed * 0x9E3779B97F4A7C15ull + run) {}

  std::string make() {
    std::string text = pick(seeds_);
    for (std::size_t n = 1 + below(1u << below(6)); n > 0; --n) step(text);
    if (text.size() > max_size) text.resize(max_size);
    return text;
  }

 private:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random_() % n); }
  const std::string& pick(const std::vector<std::string>& list) { return list[below(list.size())]; }
  /// Begin and length of a piece of the text: a few bytes, a field or a line.
  std::pair<std::size_t, std::size_t> part(const std::string& text) {
    const std::size_t at = below(text.size() + 1);
    const char* ends = below(2) ? "\n" : ",\t\n<>";
    switch (below(3)) {
      case 0:
        return {at, below(std::min<std::size_t>(text.size() - at, 16) + 1)};
      default: {
        const auto before = text.find_last_of(ends, at);
        const std::size_t first = before == std::string::npos || before >= text.size() ? 0 : before + 1;
        const auto end = text.find_first_of(ends, first);
        return {first, (end == std::string::npos ? text.size() : end) - first};
      }
    }
  }
  void step(std::string& text) {
    const auto [at, n] = part(text);
    switch (below(9)) {
      case 0:
        if (!text.empty()) text[below(text.size())] = static_cast<char>(random_());
        break;
      case 1:
        text.erase(at, n);
        break;
      case 2:
        if (text.size() < max_size) text.insert(at, text.substr(at, n));
        break;
      case 3:
      case 4:
        text.insert(at, pick(pieces));
        break;
      case 5:
        text.replace(at, n, pick(pieces));
        break;
      case 6: {  // of another input
        const std::string& other = pick(seeds_);
        const auto [from, m] = part(other);
        text.insert(at, other.substr(from, m));
        break;
      }
      case 7: {  // a piece somewhere else
        const std::string piece = text.substr(at, n);
        text.erase(at, n);
        text.insert(below(text.size() + 1), piece);
        break;
      }
      default:
        text.insert(at, std::string(1 + below(below(8) == 0 ? 5000 : 40), pick(pieces)[0]));
    }
    if (text.size() > 2 * max_size) text.resize(max_size);
  }

  const std::vector<std::string>& seeds_;
  std::mt19937_64 random_;
};

std::string slurp(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

int usage() {
  std::fprintf(stderr,
               "usage: fuzz_input [--runs N] [--seconds CPU_SECONDS] [--seed K] [--first N] [--keep FILE] SEEDS...\n"
               "  SEEDS are files and folders; each is tried as it is, then mutated. Ends at --runs or --seconds.\n");
  return 64;
}

}  // namespace

int main(int argc, char** argv) {
  unsigned long long runs = ~0ull, first = 0, seed = 1;
  double seconds = 1e18;
  std::string keep;
  std::vector<fs::path> files;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool flag = word.rfind("--", 0) == 0;
    if (!flag) {
      if (fs::is_directory(word))
        for (const auto& entry : fs::directory_iterator(word)) files.push_back(entry.path());
      else
        files.push_back(word);
    } else if (i + 1 >= argc) {
      return usage();
    } else if (word == "--runs") {
      runs = std::strtoull(argv[++i], nullptr, 10);
    } else if (word == "--first") {
      first = std::strtoull(argv[++i], nullptr, 10);
    } else if (word == "--seed") {
      seed = std::strtoull(argv[++i], nullptr, 10);
    } else if (word == "--seconds") {
      seconds = std::strtod(argv[++i], nullptr);
    } else if (word == "--keep") {
      keep = argv[++i];
    } else {
      return usage();
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> seeds;
  for (const fs::path& file : files) seeds.push_back(slurp(file));
  if (seeds.empty() || (runs == ~0ull && seconds > 1e17)) return usage();
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_set_death_callback(say_where);
#endif
  std::signal(SIGABRT, on_signal);
  std::signal(SIGSEGV, on_signal);
  current_seed = seed;
  if (first == 0)
    for (const std::string& text : seeds) check_input(text);
  unsigned long long done = 0;
  for (; done < runs; ++done) {
    if (done % 64 == 0 && static_cast<double>(std::clock()) / CLOCKS_PER_SEC > seconds) break;
    current_run = first + done;
    current_text = Mutator(seeds, seed, current_run).make();
    if (!keep.empty()) std::ofstream(keep, std::ios::binary) << current_text;
    check_input(current_text);
  }
  std::printf("fuzz_input: %llu inputs of %zu seeds, %.1f s of a processor, no broken promise\n", done, seeds.size(),
              static_cast<double>(std::clock()) / CLOCKS_PER_SEC);
  return 0;
}
