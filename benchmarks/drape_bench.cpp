// SPDX-License-Identifier: GPL-3.0-or-later
#include "drape_bench.hpp"

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <memory>

#include "mesh_bench.hpp"
#include "vitrine/mannequin.hpp"
#include "vitrine/sewing.hpp"
#include "vitrine/templates/fabrics.hpp"

namespace vitrine::bench {
namespace {

struct DrapeCommand {
  std::string folder, out, blender;
  double residual = 1e-3, spacing = 0.006, blender_stop = 0.01;
  int repeat = 1, blender_frames = 250;
  std::vector<int> level_nodes = {300, 2000, 6500, 20000};  // what the engine's qualities go through
};

Fabric cotton() {
  const vitrine_fabric& f = templates::cotton_woven;
  return {f.name, f.stretch, f.shear, f.bend, f.mass, f.friction};
}

/// A run from the case's files in memory to the cloth at rest.
struct Run {
  Drape drape;
  double level_ms = 0, field_ms = 0, drape_ms = 0;
  double total_ms() const { return level_ms + field_ms + drape_ms; }
};

template <class T>
T must(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().code + ": " + result.error().message);
  return *std::move(result);
}

Run drape_once(const DrapeCase& input, const DrapeCommand& command) {
  Run run;
  double start = cpu_ms();
  std::vector<Pattern> levels;
  const auto given = static_cast<double>(2 * input.pattern.meshes[0].nodes.size());
  for (const int nodes : command.level_nodes)
    if (nodes < 0.6 * given) levels.push_back(coarser_pattern(input, nodes));
  levels.push_back(input.pattern);
  run.level_ms = cpu_ms() - start;
  start = cpu_ms();
  const DistanceField field = must(voxelise(input.body, {.spacing = command.spacing}));
  run.field_ms = cpu_ms() - start;
  start = cpu_ms();
  SewingOptions options;
  options.residual = command.residual;
  run.drape = must(sew_and_drape(levels, place_flat(levels.front(), input.panel_distance), cotton(), field, options));
  run.drape_ms = cpu_ms() - start;
  return run;
}

void write_obj(const DrapeCase& input, const Drape& drape, const std::string& file) {
  std::ofstream out(file);
  char line[96];
  std::size_t base = 1;
  for (std::size_t p = 0; p < 2; ++p)
    for (const Vec3& q : drape.positions[p]) {
      std::snprintf(line, sizeof line, "v %.6f %.6f %.6f\n", q.x(), -q.z(), q.y());
      out << line;
    }
  for (std::size_t p = 0; p < 2; ++p) {
    for (const Triangle& t : input.pattern.meshes[p].triangles) {
      // The back is counter-clockwise seen from the front.
      const auto b = t[p == 0 ? 1 : 2], c = t[p == 0 ? 2 : 1];
      out << "f " << base + t[0] << ' ' << base + b << ' ' << base + c << '\n';
    }
    base += drape.positions[p].size();
  }
  if (!out.flush()) throw std::runtime_error(file + ": cannot be written");
}

nlohmann::ordered_json levels_json(const Drape& drape) {
  auto out = nlohmann::ordered_json::array();
  for (const LevelFigures& l : drape.levels)
    out.push_back({{"nodes", l.nodes},
                   {"iterations", l.iterations},
                   {"residual", l.residual},
                   {"change_mean_mm", l.change_mean_mm},
                   {"change_max_mm", l.change_max_mm}});
  return out;
}

/// Blender has no residual: its time to rest ends at the first frame in which no vertex is faster than `stop`, or was
/// not reached in the frames it was given (`rested` false: the time is a lower bound).
void compare(nlohmann::ordered_json& line, const DrapeCommand& command) {
  nlohmann::ordered_json peer =
      run_blender(command.blender, command.folder, command.blender_stop, command.blender_frames);
  char name[32];
  std::snprintf(name, sizeof name, "max<%g", command.blender_stop);
  const double frames = peer.at("frames").get<double>();
  const bool rested = peer.at("rest").contains(name);
  const double until = rested ? peer.at("rest").at(name).get<double>() : frames;
  // The script runs five more frames to be sure; they are not counted.
  const double seconds = peer.at("cpu_s").get<double>() * (until - 1) / (frames - 1);
  line["blender_rested"] = rested;
  line["blender_cpu_s"] = seconds;
  line["blender_ratio"] = seconds / line.at("cpu_s").get<double>();
  for (const char* drop : {"vmax_series", "vmean_series", "gap_series_mm", "gap_at_frame"}) peer.erase(drop);
  line["blender"] = std::move(peer);
}

int run(const DrapeCommand& command) {
  const DrapeCase input = read_drape_case(command.folder);
  std::vector<double> total, field, level, drape;
  Run last;
  for (int i = 0; i < command.repeat; ++i) {
    last = drape_once(input, command);
    total.push_back(1e-3 * last.total_ms());
    level.push_back(1e-3 * last.level_ms);
    field.push_back(1e-3 * last.field_ms);
    drape.push_back(1e-3 * last.drape_ms);
  }
  const Drape& d = last.drape;
  nlohmann::ordered_json line = {
      {"case", command.folder},   {"fabric", cotton().name},          {"status", d.status},
      {"cpu_s", median(total)},   {"coarse_meshes_s", median(level)}, {"field_s", median(field)},
      {"drape_s", median(drape)}, {"residual", d.residual},           {"weld_gap_max_mm", d.seam_gap_mm_max}};
  line.update(drape_figures(input, d.positions));
  line["stiffness_cap"] = d.stiffness_cap;
  line["levels"] = levels_json(d);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  line["rss_peak_mb"] = usage.ru_maxrss / 1024;
  if (!command.out.empty()) write_obj(input, d, command.out);
  if (!command.blender.empty()) compare(line, command);
  std::printf("%s\n", line.dump().c_str());
  return d.status == "OK" ? 0 : 1;
}

}  // namespace

std::function<int()> add_drape_command(CLI::App& app) {
  auto command = std::make_shared<DrapeCommand>();
  CLI::App* sub = app.add_subcommand("drape", "Sew and drape two panels on a body; one JSON line");
  sub->add_option("--case", command->folder, "Folder with front.obj, back.obj, body.obj and seams.json")->required();
  sub->add_option("--residual", command->residual, "Net force over weight to stop at")->check(CLI::PositiveNumber);
  sub->add_option("--out", command->out, "Write the garment as OBJ, z up as the case is");
  sub->add_option("--levels", command->level_nodes,
                  "Nodes of the coarser levels; those near the case's own are left out")
      ->delimiter(',');
  sub->add_option("--spacing", command->spacing, "Voxel edge [m]")->check(CLI::PositiveNumber);
  sub->add_option("--repeat", command->repeat, "Runs to take the median times of")->check(CLI::Range(1, 1000));
  sub->add_option("--blender", command->blender, "Blender script to run beside, with quality 10 on one thread");
  sub->add_option("--blender-stop", command->blender_stop, "Speed [m/s] below which Blender's cloth is at rest");
  sub->add_option("--blender-frames", command->blender_frames, "Frames that Blender is given to come to rest");
  return [command] { return run(*command); };
}

}  // namespace vitrine::bench
