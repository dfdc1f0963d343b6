// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "mesh_bench.hpp"
#include "outlines.hpp"

namespace vitrine::bench {
namespace {

struct PeersCommand {
  std::vector<std::string> polys;
  std::string csv, svg;
  int repeat = 5, lloyd = 50, lloyd_limit = 12'000;
  bool scaling = false;
};

/// An outline of the tests, with the edge length at which a uniform mesh has that many nodes.
OutlineCase drawn(const std::string& name, test::Outline (*shape)(double), double nodes) {
  const auto area = [](const test::Outline& p) {
    double twice = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
      twice += p[i].x() * p[(i + 1) % p.size()].y() - p[(i + 1) % p.size()].x() * p[i].y();
    return 0.5 * twice;
  };
  OutlineCase made;
  made.name = name;
  made.edge_length = std::sqrt(area(shape(0.002)) / (nodes * std::numbers::sqrt3 / 2));
  made.outline = shape(made.edge_length);
  return made;
}

std::vector<OutlineCase> cases_of(const PeersCommand& command) {
  std::vector<OutlineCase> cases;
  for (const std::string& file : command.polys) cases.push_back(read_poly(file));
  if (command.scaling)
    for (const double nodes : {1e3, 3162., 1e4, 31623., 1e5}) cases.push_back(drawn("vest", test::vest, nodes));
  if (!cases.empty()) return cases;
  const std::pair<const char*, test::Outline (*)(double)> shapes[] = {
      {"vest", test::vest}, {"sleeves", test::sleeves}, {"skirt", test::skirt}, {"v_neck", test::v_neck}};
  for (const double nodes : {900., 10'000.})
    for (const auto& [name, shape] : shapes) cases.push_back(drawn(name, shape, nodes));
  return cases;
}

void print(const PeerRow& r) {
  std::printf(
      "%-9s %-15s %7d nodes %9.1f ms  angle %4.1f / %4.1f  <1.3 %5.2f %%  >1.6 %6.2f %%  CV %.4f  valence 6 %5.1f %%\n",
      r.outline.c_str(), r.mesher.c_str(), r.stats.nodes, r.ms, r.stats.min_angle_deg, r.stats.mean_min_angle_deg,
      100 * r.stats.flat_share, 100 * r.stats.good_share, r.stats.edge_cv, 100 * r.stats.valence6_share);
}

int run(const PeersCommand& command) {
  if (!have_gmsh())
    std::fprintf(stderr, "Built without gmsh (Debian package libgmsh-dev): compared with CGAL alone.\n");
  std::vector<PeerRow> rows;
  for (const OutlineCase& c : cases_of(command)) {
    std::vector<double> ours, gmsh;
    PanelMesh mesh;
    PeerRun peer;
    // Turn about, so that a slow spell of the machine meets both.
    for (int i = 0; i < command.repeat; ++i) {
      const double start = cpu_ms();
      auto made = mesh_panel(c.outline, {.edge_length = c.edge_length}, c.holes);
      ours.push_back(cpu_ms() - start);
      if (!made) {
        std::fprintf(stderr, "%s: %s %s\n", c.name.c_str(), made.error().code.c_str(), made.error().message.c_str());
        return made.error().exit_code();
      }
      mesh = *std::move(made);
      if (!have_gmsh()) continue;
      peer = run_gmsh_frontal(c);
      gmsh.push_back(peer.ms);
    }
    const auto add = [&](const char* mesher, double ms, const PanelMesh& m) {
      rows.push_back({c.name, mesher, c.edge_length, ms, measure_mesh(m)});
      print(rows.back());
    };
    add("vitrine", median(ours), mesh);
    if (have_gmsh()) add("gmsh frontal", median(gmsh), peer.mesh);
    if (static_cast<int>(mesh.nodes.size()) > command.lloyd_limit) continue;
    const PeerRun lloyd = run_cgal_lloyd(c, command.lloyd);
    add("CGAL Lloyd", lloyd.ms, lloyd.mesh);
  }
  if (!command.csv.empty()) write_csv(rows, command.csv);
  if (!command.svg.empty()) write_svg(rows, command.svg);
  return 0;
}

}  // namespace

std::function<int()> add_mesh_peers_command(CLI::App& app) {
  auto command = std::make_shared<PeersCommand>();
  CLI::App* sub = app.add_subcommand("mesh-peers", "The mesher beside gmsh's and CGAL's on the same outlines");
  sub->add_option("--poly", command->polys, "Outline files; four drawn garments at 900 and 10,000 nodes otherwise");
  sub->add_flag("--scaling", command->scaling, "A vest at 1,000 to 100,000 nodes");
  sub->add_option("--repeat", command->repeat, "Runs to take the median time of")->check(CLI::Range(1, 1000));
  sub->add_option("--lloyd", command->lloyd, "Rounds of CGAL's Lloyd");
  sub->add_option("--lloyd-limit", command->lloyd_limit, "No Lloyd above this many nodes: it takes seconds");
  sub->add_option("--csv", command->csv, "Keep the table");
  sub->add_option("--svg", command->svg, "Draw time and evenness over the node count");
  return [command] { return run(*command); };
}

}  // namespace vitrine::bench
