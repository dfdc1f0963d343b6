// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_bench.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace vitrine::bench {

double cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

OutlineCase read_poly(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file + ": cannot be read");
  OutlineCase result;
  result.name = file;
  std::string line;
  int number = 0;
  const auto next = [&] {
    while (std::getline(in, line)) {
      ++number;
      if (line.find_first_not_of(" \t\r") != std::string::npos) return true;
    }
    return false;
  };
  const auto fail = [&](const std::string& expected) {
    throw std::runtime_error(file + ":" + std::to_string(number) + ": expected " + expected);
  };
  for (bool outline = true; next(); outline = false) {
    std::istringstream head(line);
    long count = 0;
    if (!(head >> count) || count < 0 || count > 10'000'000) fail("a count of points");
    if (outline && !(head >> result.edge_length)) fail("a count and an edge length");
    std::vector<Vec2> loop;
    for (long i = 0; i < count; ++i) {
      if (!next()) fail(std::to_string(count) + " points, found " + std::to_string(i));
      std::istringstream row(line);
      std::string x, y;
      if (!(row >> x >> y)) fail("x y");
      try {
        loop.emplace_back(std::stod(x), std::stod(y));  // takes "nan" and "inf": the room answers for them
      } catch (const std::exception&) {
        fail("two numbers");
      }
    }
    if (outline)
      result.outline = std::move(loop);
    else
      result.holes.push_back(std::move(loop));
  }
  if (number == 0) fail("a count and an edge length");
  return result;
}

nlohmann::ordered_json figures_json(const MeshStats& s) {
  const auto percent = [](double share) { return 100 * share; };
  return {{"nodes", s.nodes},
          {"triangles", s.triangles},
          {"min_angle_deg", s.min_angle_deg},
          {"mean_min_angle_deg", s.mean_min_angle_deg},
          {"ratio_below_1_3_pct", percent(s.flat_share)},
          {"ratio_1_3_to_1_6_pct", percent(std::max(0.0, 1 - s.flat_share - s.good_share))},
          {"ratio_above_1_6_pct", percent(s.good_share)},
          {"edge_mean_mm", 1e3 * s.edge_mean},
          {"edge_cv", s.edge_cv},
          {"valence6_interior_pct", percent(s.valence6_share)}};
}

namespace {

struct MeshCommand {
  std::string poly, out;
  double edge = 0;
  int repeat = 1;
};

void write_obj(const PanelMesh& mesh, const std::string& file) {
  std::ofstream out(file);
  char line[96];
  for (const Vec2& p : mesh.nodes) {
    std::snprintf(line, sizeof line, "v %.17g %.17g 0\n", p.x(), p.y());
    out << line;
  }
  for (const Triangle& t : mesh.triangles) out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  if (!out.flush()) throw std::runtime_error(file + ": cannot be written");
}

int run(const MeshCommand& command) {
  const OutlineCase input = read_poly(command.poly);
  const MeshOptions options{.edge_length = command.edge > 0 ? command.edge : input.edge_length};
  std::vector<double> times;
  PanelMesh mesh;
  for (int i = 0; i < command.repeat; ++i) {
    const double start = cpu_ms();
    auto made = mesh_panel(input.outline, options, input.holes);
    times.push_back(cpu_ms() - start);
    if (!made) {
      const Error& e = made.error();
      std::fprintf(stderr, "%s: %s %s\n", e.code.c_str(), e.message.c_str(), e.remedy.c_str());
      return e.exit_code();
    }
    mesh = *std::move(made);
  }
  nlohmann::ordered_json line = {{"poly", command.poly}, {"edge_length_m", options.edge_length}};
  line.update(figures_json(measure_mesh(mesh)));
  line["cpu_ms_median"] = median(times);
  line["repeat"] = command.repeat;
  if (!command.out.empty()) write_obj(mesh, command.out);
  std::printf("%s\n", line.dump().c_str());
  return 0;
}

}  // namespace

std::function<int()> add_mesh_command(CLI::App& app) {
  auto command = std::make_shared<MeshCommand>();
  CLI::App* sub = app.add_subcommand("mesh", "Mesh one outline; one JSON line");
  sub->add_option("--poly", command->poly, "Outline: count and edge length [m], then x y; further counts begin holes")
      ->required();
  sub->add_option("--edge", command->edge, "Target edge length [m]; the file's otherwise")->check(CLI::PositiveNumber);
  sub->add_option("--out", command->out, "Write the mesh as OBJ");
  sub->add_option("--repeat", command->repeat, "Runs to take the median time of")->check(CLI::Range(1, 100000));
  return [command] { return run(*command); };
}

}  // namespace vitrine::bench
