// SPDX-License-Identifier: GPL-3.0-or-later
// vitrine-extremes-bench: constants, meshes, bodies and photos far beyond what anybody means. Every case has to end in
// a result that can be believed, in a status that says what is wrong with it, or in a refusal; a crash, a number that
// is none, or a run without end is a bug. Run by hand; never part of a test.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "extremes.hpp"

namespace {

namespace fs = std::filesystem;
using namespace vitrine::bench;

/// Removed when the program ends.
struct Workshop {
  fs::path folder;
  explicit Workshop(std::string given) : folder(std::move(given)) {
    if (folder.empty()) {
      std::string made = (fs::temp_directory_path() / "vitrine-extremes-XXXXXX").string();
      if (!mkdtemp(made.data())) throw std::runtime_error("cannot make a temporary folder");
      folder = made;
      own = true;
    }
    fs::create_directories(folder);
  }
  ~Workshop() {
    std::error_code ignored;
    if (own) fs::remove_all(folder, ignored);
  }
  bool own = false;
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Stability at the extremes", "vitrine-extremes-bench");
  std::string csv, meshes, work, only;
  int cpu_seconds = 300, megabytes = 8192;
  app.add_option("--csv", csv, "Write one row for each case");
  app.add_option("--meshes", meshes, "Folder of other people's bodies (OBJ); skipped where it is not there");
  app.add_option("--work", work, "Keep the drawn photos in this folder");
  app.add_option("--only", only, "Only groups or cases whose name contains this");
  app.add_option("--cpu", cpu_seconds, "Seconds of processor for one case")->capture_default_str();
  app.add_option("--memory", megabytes, "Megabytes of address space for one case")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    const Workshop workshop(work);
    std::ofstream out;
    if (!csv.empty()) out.open(csv);
    out << csv_head;
    int count = 0, bad = 0;
    Extremes extremes(workshop.folder.string(), meshes);
    extremes.each_case([&](const std::string& group, const std::string& name, const std::function<Outcome()>& body) {
      if ((group + " " + name).find(only) == std::string::npos) return;
      const Outcome outcome = run_apart(body, cpu_seconds, megabytes);
      const std::string row = csv_row(group, name, outcome);
      out << row;
      out.flush();
      std::printf("%s%s", outcome.as_it_should_be() ? "" : "BAD ", row.c_str());
      std::fflush(stdout);
      ++count;
      bad += !outcome.as_it_should_be();
    });
    std::printf("%d cases, %d of them neither a believable result nor a named refusal\n", count, bad);
    return bad == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vitrine-extremes-bench: %s\n", error.what());
    return 66;
  }
}
