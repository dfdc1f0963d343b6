// SPDX-License-Identifier: GPL-3.0-or-later
// What each room costs: the mesher by node count, the mannequin and its voxels, and whole items by quality with the
// figures of the drape beside the time. Read ratios within one run; absolute times are the machine's.
#include <benchmark/benchmark.h>

#include <cmath>

#include "vitrine/host/registry.hpp"
#include "vitrine/pipeline.hpp"

namespace vitrine {
namespace {

/// A skirt-like outline of about `nodes` nodes after meshing.
void mesh(benchmark::State& state) {
  const double height = 0.6, top = 0.36, bottom = 0.56;
  const double area = height * (top + bottom) / 2;
  MeshOptions options;
  options.edge_length = std::sqrt(area / (static_cast<double>(state.range(0)) * std::sqrt(3.0) / 2));
  const Vec2 corners[] = {{-bottom / 2, 0}, {bottom / 2, 0}, {top / 2, height}, {-top / 2, height}};
  std::vector<Vec2> outline;
  for (int c = 0; c < 4; ++c) {
    const Vec2 from = corners[c], to = corners[(c + 1) % 4];
    const int pieces = static_cast<int>(std::lround((to - from).norm() / options.edge_length));
    for (int i = 0; i < pieces; ++i) outline.push_back(from + (to - from) * i / pieces);
  }
  MeshStats figures;
  for (auto _ : state) {
    const auto made = mesh_panel(outline, options);
    if (!made) return state.SkipWithError(made.error().message.c_str());
    figures = measure_mesh(*made);
  }
  state.counters["nodes"] = figures.nodes;
  state.counters["edge_cv"] = figures.edge_cv;
  state.counters["mean_min_angle_deg"] = figures.mean_min_angle_deg;
}
BENCHMARK(mesh)->Arg(150)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

void mannequin(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(build_mannequin({}));
}
BENCHMARK(mannequin)->Unit(benchmark::kMillisecond)->Iterations(2);

const std::shared_ptr<const Body>& body() {
  static const std::shared_ptr<const Body> made = [] {
    auto b = std::make_shared<Body>();
    b->mannequin = *build_mannequin({});
    b->field = *voxelise(b->mannequin.mesh);
    return b;
  }();
  return made;
}

void voxels(benchmark::State& state) {
  const TriMesh& surface = body()->mannequin.mesh;
  for (auto _ : state) benchmark::DoNotOptimize(voxelise(surface));
}
BENCHMARK(voxels)->Unit(benchmark::kMillisecond)->Iterations(2);

void item(benchmark::State& state, const char* garment, const char* name, Quality quality) {
  PluginSearch search;
  search.folders = {std::string(VITRINE_BINARY_DIR) + "/lib/vitrine-1/plugins"};
  search.built_in = false;
  const PluginRegistry registry = PluginRegistry::load(search);
  const std::string photo = std::string(VITRINE_SOURCE_DIR) + "/catalog/sample/" + name;
  ConvertRequest request;
  request.front = photo + "-front.jpg";
  request.back = photo + "-back.jpg";
  request.garment = *registry.find_garment(garment);
  request.necklines = registry.necklines();
  request.quality = quality;
  request.body = body();
  Conversion made;
  for (auto _ : state) made = convert(request);
  if (made.error) state.SkipWithError(made.error->message.c_str());
  for (const auto& [room, ms] : made.stage_ms) state.counters[room + "_ms"] = ms;
  state.counters["residual"] = made.drape.residual;
  if (!made.drape.levels.empty()) {
    state.counters["nodes"] = made.drape.levels.back().nodes;
    state.counters["change_mean_mm"] = made.drape.levels.back().change_mean_mm;
  }
}
#define ITEM(garment, name, label)                                                                                     \
  BENCHMARK_CAPTURE(item, label##_draft, garment, name, Quality::draft)->Unit(benchmark::kMillisecond)->Iterations(1); \
  BENCHMARK_CAPTURE(item, label##_standard, garment, name, Quality::standard)                                          \
      ->Unit(benchmark::kMillisecond)                                                                                  \
      ->Iterations(1);                                                                                                 \
  BENCHMARK_CAPTURE(item, label##_fine, garment, name, Quality::fine)->Unit(benchmark::kMillisecond)->Iterations(1);
ITEM("vest", "vest-sailor", vest)
ITEM("long_sleeve", "long-sleeve-sunrise", long_sleeve)
ITEM("skirt", "skirt-garden", skirt)
#undef ITEM

}  // namespace
}  // namespace vitrine
