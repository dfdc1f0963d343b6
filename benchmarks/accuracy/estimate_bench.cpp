// SPDX-License-Identifier: GPL-3.0-or-later
// vitrine-estimate-bench: the error estimate of each mesh level against the distance to a finer reference, as CSV. Run
// by hand; never part of a test.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>

#include "../marked_photos.hpp"
#include "vitrine/accuracy.hpp"
#include "vitrine/catalog.hpp"
#include "vitrine/host/registry.hpp"
#include "vitrine/pipeline.hpp"

namespace {

using namespace vitrine;
namespace fs = std::filesystem;

using bench::Item;
using bench::marked_photos;
using bench::must;

std::vector<Item> of_manifest(const std::string& file) {
  std::vector<Item> items;
  for (const CatalogItem& row : must(read_manifest(file)))
    items.push_back({row.sku, row.garment, row.front, row.mirror_back ? "" : row.back, "",
                     row.chest_cm.value_or(0) / 100, row.length_cm.value_or(0) / 100});
  return items;
}

std::shared_ptr<const Body> body_of(const std::string& who) {
  auto body = std::make_shared<Body>();
  const auto preset = preset_measurements(who);
  body->mannequin = must(preset ? build_mannequin(*preset) : import_mannequin(who));
  body->field = must(voxelise(body->mannequin.mesh));
  return body;
}

double sewing_seconds(const Conversion& made) {
  double ms = 0;
  for (const auto& [room, value] : made.stage_ms) ms += room == "sewing" ? value : 0;
  return ms / 1e3;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("The error estimate against the distance to a finer mesh", "vitrine-estimate-bench");
  std::string photos, manifest, csv, who = "woman-m", set = "items";
  std::vector<std::string> only;
  std::vector<int> nodes = {300, 2000, 6500, 20000, 50000};
  double last_residual = 3e-4, first_residual = 1e-3;
  app.add_option("--photos", photos, "Folder of marked photos with index.tsv");
  app.add_option("--manifest", manifest, "Catalogue of items");
  app.add_option("--items", only, "Only the items of these names")->delimiter(',');
  app.add_option("--mannequin", who, "Preset or mesh file")->capture_default_str();
  app.add_option("--levels", nodes, "Node counts of the mesh levels; the last is the reference")->delimiter(',');
  app.add_option("--reference-residual", last_residual, "Residual of the reference")->capture_default_str();
  app.add_option("--residual", first_residual, "Residual of the levels that are judged")->capture_default_str();
  app.add_option("--set", set, "Name of the set, the first column")->capture_default_str();
  app.add_option("--csv", csv, "Write the rows here too");
  CLI11_PARSE(app, argc, argv);

  PluginSearch search;
  search.folders = {std::string(VITRINE_BINARY_DIR) + "/lib/vitrine-1/plugins"};
  search.built_in = false;
  const PluginRegistry registry = PluginRegistry::load(search);
  try {
    std::vector<Item> items = manifest.empty() ? marked_photos(photos, registry) : of_manifest(manifest);
    const auto body = body_of(who);
    std::ofstream out;
    if (!csv.empty()) out.open(csv);
    const char* head =
        "set,item,garment,fabric,level,nodes,edge_mm,steps,residual,change_mm,surface_change_mm,loose_turn,gap_mm,"
        "estimate_mm,true_mm,true_p95_mm,true_max_mm,sewing_s,status\n";
    out << head;
    std::fputs(head, stdout);
    for (const Item& item : items) {
      if (!only.empty() && std::find(only.begin(), only.end(), item.name) == only.end()) continue;
      ConvertRequest request;
      request.name = item.name;
      request.front = item.front;
      request.back = item.back;
      request.mirror_back = item.back.empty();
      request.chest = item.chest;
      request.length = item.length;
      request.garment = *registry.find_garment(item.garment);
      request.necklines = registry.necklines();
      request.body = body;
      std::vector<Conversion> made;
      for (std::size_t l = 0; l < nodes.size(); ++l) {
        request.settings = settings_of(Quality::fine);
        request.settings->level_nodes.assign(nodes.begin(), nodes.begin() + static_cast<long>(l) + 1);
        request.settings->residual = l + 1 == nodes.size() ? last_residual : first_residual;
        if (l + 1 == nodes.size()) request.settings->max_iterations = MeasureOptions{}.reference_iterations;
        made.push_back(cut_and_sew(request));
        if (made.back().drape.levels.empty()) {
          std::fprintf(stderr, "%s: %s\n", item.name.c_str(), made.back().error->message.c_str());
          break;
        }
      }
      if (made.size() < nodes.size() || made.back().drape.levels.empty()) continue;
      const TriMesh reference = garment_surface(made.back().pattern, made.back().drape);
      for (std::size_t l = 0; l < made.size(); ++l) {
        const Drape& d = made[l].drape;
        const LevelFigures& f = d.levels.back();
        SurfaceDistance gap;
        if (l + 1 < made.size()) gap = surface_distance(garment_surface(made[l].pattern, made[l].drape), reference);
        char row[500];
        std::snprintf(row, sizeof row,
                      "%s,%s,%s,%s,%zu,%d,%.2f,%d,%.2e,%.3f,%.3f,%.5f,%.2f,%.3f,%.3f,%.3f,%.2f,%.3f,%s\n", set.c_str(),
                      item.name.c_str(), item.garment.c_str(), made[l].fabric.name.c_str(), l, f.nodes, f.edge_mm,
                      f.iterations, d.residual, f.change_mean_mm, f.change_surface_mm, f.loose_turn, f.gap_mm,
                      d.error_estimate_mm.value_or(-1), gap.mean_mm, gap.p95_mm, gap.max_mm, sewing_seconds(made[l]),
                      d.status.c_str());
        out << row << std::flush;
        std::fputs(row, stdout);
        std::fflush(stdout);
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vitrine-estimate-bench: %s\n", error.what());
    return 66;
  }
  return 0;
}
