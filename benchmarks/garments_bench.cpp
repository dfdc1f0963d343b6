// SPDX-License-Identifier: GPL-3.0-or-later
// vitrine-garments-bench: photos x fabrics x mannequins sewn and draped, one CSV row each, and what share of them came
// to rest within the bars. Run by hand; never part of a test.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "marked_photos.hpp"
#include "vitrine/host/registry.hpp"
#include "vitrine/pipeline.hpp"

namespace {

using namespace vitrine;
namespace fs = std::filesystem;

using bench::Item;
using bench::marked_photos;
using bench::must;

std::vector<Item> sample_photos() {
  std::vector<Item> items;
  for (const char* row :
       {"vest vest-sailor", "vest vest-terracotta", "long_sleeve long-sleeve-sunrise",
        "long_sleeve long-sleeve-mustard", "skirt skirt-garden", "skirt skirt-denim", "t_shirt t-shirt-dots",
        "dress dress-meadow", "trousers trousers-indigo", "shorts shorts-olive"}) {
    const std::string text = row;
    const auto space = text.find(' ');
    const std::string name = text.substr(space + 1),
                      photo = std::string(VITRINE_SOURCE_DIR) + "/catalog/sample/" + name;
    items.push_back({name, text.substr(0, space), photo + "-front.jpg", photo + "-back.jpg", ""});
  }
  return items;
}

/// A preset such as woman-xs, or a mesh file.
std::shared_ptr<const Body> body_of(const std::string& who) {
  auto body = std::make_shared<Body>();
  const auto preset = preset_measurements(who);
  body->mannequin = must(preset ? build_mannequin(*preset) : import_mannequin(who));
  body->field = must(voxelise(body->mannequin.mesh));
  return body;
}

double median(std::vector<double> v) {
  if (v.empty()) return 0;
  std::nth_element(v.begin(), v.begin() + v.size() / 2, v.end());
  return v[v.size() / 2];
}

struct Tally {
  int runs = 0, good = 0;
  std::map<std::string, int> why;
  std::vector<double> seconds;
  void add(const std::string& verdict, double sewing_s) {
    ++runs;
    good += verdict == "OK";
    if (verdict != "OK") ++why[verdict];
    seconds.push_back(sewing_s);
  }
  void print(const std::string& name) const {
    std::printf("%-28s %4d of %4d within the bars (%.1f %%), sewing %.3f s median", name.c_str(), good, runs,
                runs ? 100.0 * good / runs : 0.0, median(seconds));
    for (const auto& [what, count] : why) std::printf("; %d x %s", count, what.c_str());
    std::printf("\n");
  }
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Photos x fabrics x mannequins, sewn and draped", "vitrine-garments-bench");
  std::string photos, csv, quality = "standard", only;
  std::vector<std::string> bodies = {"woman-xs", "woman-m", "woman-xxl"};
  bool every_fabric = false;
  app.add_option("--photos", photos, "Folder of marked photos with index.tsv; without it the sample catalogue");
  app.add_option("--mannequins", bodies, "Presets and mesh files")->delimiter(',')->capture_default_str();
  app.add_option("--quality", quality, "draft, standard or fine")->capture_default_str();
  app.add_option("--only", only, "Only items whose name contains this");
  app.add_flag("--fabrics", every_fabric, "Every fabric of the garment, not its first alone");
  app.add_option("--csv", csv, "Write one row for each run");
  CLI11_PARSE(app, argc, argv);

  PluginSearch search;
  search.folders = {std::string(VITRINE_BINARY_DIR) + "/lib/vitrine-1/plugins"};
  search.built_in = false;
  const PluginRegistry registry = PluginRegistry::load(search);
  const std::vector<Item> items = photos.empty() ? sample_photos() : marked_photos(photos, registry);
  std::ofstream out;
  if (!csv.empty()) out.open(csv);
  out << "item,garment,fabric,mannequin,verdict,residual,gap_mm,penetration_mm,stretch_p99,strain_max,nodes,steps,"
         "change_mean_mm,self_touching,self_crossed,self_crossed_mm,sewing_s\n";
  std::map<std::string, Tally> by_garment, by_body;
  Tally all;
  try {
    for (const std::string& who : bodies) {
      const auto body = body_of(who);
      const std::string body_name = fs::path(who).stem().string();
      for (const Item& item : items) {
        if (item.name.find(only) == std::string::npos) continue;
        ConvertRequest request;
        request.name = item.name;
        request.front = item.front;
        request.back = item.back;
        request.mirror_back = item.back.empty();
        request.garment = *registry.find_garment(item.garment);
        request.necklines = registry.necklines();
        request.quality = quality == "draft" ? Quality::draft : quality == "fine" ? Quality::fine : Quality::standard;
        request.body = body;
        for (const Fabric& fabric : request.garment.fabrics) {
          request.fabric = fabric.name;
          const Conversion made = cut_and_sew(request);
          const Drape& d = made.drape;
          if (d.levels.empty() && made.error && made.error->stage != "sewing" && made.error->stage != "fit") {
            std::printf("%-16s the photo is refused: %s\n", item.name.c_str(), made.error->code.c_str());
            break;  // not a matter of cloth or body
          }
          const std::string verdict = !made.error ? (d.status.empty() ? "?" : d.status) : made.error->code;
          const bool kept = verdict != "OK" || (d.seam_gap_mm_max <= 1 && d.penetration_mm_max <= 0.5);
          const std::string judged = kept ? verdict : "BAR";
          double seconds = 0;
          for (const auto& [room, ms] : made.stage_ms) seconds += room == "sewing" ? ms / 1e3 : 0;
          all.add(judged, seconds);
          by_garment[item.garment].add(judged, seconds);
          by_body[body_name].add(judged, seconds);
          const LevelFigures last = d.levels.empty() ? LevelFigures{} : d.levels.back();
          int steps = 0;
          for (const LevelFigures& l : d.levels) steps += l.iterations;
          char row[400];
          std::snprintf(row, sizeof row, "%s,%s,%s,%s,%s,%.2e,%.2f,%.3f,%.3f,%.2f,%d,%d,%.2f,%d,%d,%.1f,%.3f\n",
                        item.name.c_str(), item.garment.c_str(), fabric.name.c_str(), body_name.c_str(), judged.c_str(),
                        d.residual, d.seam_gap_mm_max, d.penetration_mm_max, d.stretch_p99, d.strain_max, last.nodes,
                        steps, last.change_mean_mm, d.self_touching, d.self_crossed, d.self_crossed_mm_max, seconds);
          out << row;
          if (judged != "OK") std::printf("%s", row);
          std::fflush(stdout);
          if (!every_fabric) break;
        }
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vitrine-garments-bench: %s\n", error.what());
    return 66;
  }
  for (const auto& [name, tally] : by_garment) tally.print(name);
  for (const auto& [name, tally] : by_body) tally.print(name);
  all.print("all");
  return all.good >= 0.95 * all.runs ? 0 : 1;
}
