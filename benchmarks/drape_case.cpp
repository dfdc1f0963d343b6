// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "drape_bench.hpp"
#include "vitrine/mesh.hpp"

namespace vitrine::bench {
namespace {

/// Vertices turned from z up, front -y to y up, front +z.
TriMesh read_obj(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file + ": cannot be read");
  TriMesh mesh;
  for (std::string line; std::getline(in, line);) {
    std::istringstream row(line);
    std::string kind;
    row >> kind;
    if (kind == "v") {
      double x = 0, y = 0, z = 0;
      if (!(row >> x >> y >> z)) throw std::runtime_error(file + ": a vertex without three numbers");
      mesh.vertices.emplace_back(x, z, -y);
    } else if (kind == "f") {
      Triangle t{};
      for (std::uint32_t& corner : t) {
        std::string name;
        row >> name;
        const long number = std::strtol(name.c_str(), nullptr, 10);
        if (number < 1) throw std::runtime_error(file + ": a face that is not a triangle of vertices");
        corner = static_cast<std::uint32_t>(number - 1);
      }
      mesh.triangles.push_back(t);
    }
  }
  for (const Triangle& t : mesh.triangles)
    for (const auto corner : t)
      if (corner >= mesh.vertices.size()) throw std::runtime_error(file + ": a face names a vertex that is not there");
  if (mesh.triangles.empty()) throw std::runtime_error(file + ": holds no triangle");
  return mesh;
}

double twice_area(const std::vector<Vec2>& p, const Triangle& t) {
  const Vec2 u = p[t[1]] - p[t[0]], w = p[t[2]] - p[t[0]];
  return u.x() * w.y() - u.y() * w.x();
}

/// The panel as it lies, counter-clockwise in the front frame.
PanelMesh flat_panel(const TriMesh& mesh) {
  PanelMesh panel;
  for (const Vec3& p : mesh.vertices) panel.nodes.emplace_back(p.x(), p.y());
  for (Triangle t : mesh.triangles) {
    if (twice_area(panel.nodes, t) < 0) std::swap(t[1], t[2]);
    panel.triangles.push_back(t);
  }
  return panel;
}

double area_of(const PanelMesh& mesh) {
  double twice = 0;
  for (const Triangle& t : mesh.triangles) twice += std::abs(twice_area(mesh.nodes, t));
  return twice / 2;
}

/// Gives the panels their outlines and the front's and back's nodes of the same number to the seams.
void add_panels(Pattern& pattern, const std::vector<Vec2>& outline) {
  pattern.panels.resize(2);
  pattern.panels[0].outline = pattern.panels[1].outline = outline;
  pattern.panels[1].side = Side::back;
}

}  // namespace

DrapeCase read_drape_case(const std::string& folder) {
  const std::string file = folder + "/seams.json";
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file + ": cannot be read");
  const auto seams = nlohmann::json::parse(in);
  DrapeCase out;
  const TriMesh front = read_obj(folder + "/front.obj"), back = read_obj(folder + "/back.obj");
  out.body = read_obj(folder + "/body.obj");
  out.panel_distance = seams.at("panel_offset_y").get<double>();
  out.segments = seams.at("boundary_segment_names").get<std::vector<std::string>>();
  const std::size_t border = out.segments.size();
  if (border > front.vertices.size() || border > back.vertices.size())
    throw std::runtime_error(file + ": an outline longer than the panels");
  out.pattern.meshes = {flat_panel(front), flat_panel(back)};
  const auto& nodes = out.pattern.meshes[0].nodes;
  add_panels(out.pattern, {nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(border)});
  out.pattern.edge_length = seams.at("h").get<double>();
  for (const auto& pair : seams.at("seam_pairs")) {
    const int a = pair.at(0).get<int>(), b = pair.at(1).get<int>();
    if (a < 0 || b < 0 || static_cast<std::size_t>(a) >= border || static_cast<std::size_t>(b) >= border)
      throw std::runtime_error(file + ": a seam away from the outline");
    // A seam's last node starts a segment that is not sewn.
    const auto sewn = [](const std::string& name) { return name.starts_with("side") || name.starts_with("shoulder"); };
    const std::string& ahead = out.segments[a];
    const std::string& name = sewn(ahead) ? ahead : out.segments[(a + border - 1) % border];
    auto found = std::find(out.sewn.begin(), out.sewn.end(), name);
    if (found == out.sewn.end()) found = out.sewn.insert(found, name);
    out.pattern.pairs.push_back({0, a, 1, b, static_cast<int>(found - out.sewn.begin())});
  }
  return out;
}

Pattern coarser_pattern(const DrapeCase& input, int nodes) {
  const auto& outline = input.pattern.panels[0].outline;
  const double area = area_of(input.pattern.meshes[0]) + area_of(input.pattern.meshes[1]);
  Pattern out;
  out.edge_length = std::sqrt(area / (nodes * std::sqrt(0.75)));
  std::vector<Vec2> coarse;
  for (std::size_t first = 0; first < outline.size();) {
    std::size_t last = first;
    std::vector<double> along(1, 0.0);
    for (; last < outline.size() && input.segments[last] == input.segments[first]; ++last)
      along.push_back(along.back() + (outline[(last + 1) % outline.size()] - outline[last]).norm());
    const int pieces = std::max(2, static_cast<int>(std::lround(along.back() / out.edge_length)));
    const auto seam = std::find(input.sewn.begin(), input.sewn.end(), input.segments[first]);
    const int start = static_cast<int>(coarse.size());
    for (int i = 0; i < pieces; ++i) {
      const double want = along.back() * i / pieces;
      const auto k = static_cast<std::size_t>(std::upper_bound(along.begin(), along.end(), want) - along.begin() - 1);
      const Vec2 from = outline[first + k], to = outline[(first + k + 1) % outline.size()];
      coarse.push_back(from + (to - from) * ((want - along[k]) / (along[k + 1] - along[k])));
    }
    if (seam != input.sewn.end())
      for (int i = start; i <= start + pieces; ++i)
        out.pairs.push_back({0, i, 1, i, static_cast<int>(seam - input.sewn.begin())});
    first = last;
  }
  for (NodePair& pair : out.pairs) pair.node_a = pair.node_b = pair.node_a % static_cast<int>(coarse.size());
  add_panels(out, coarse);
  auto made = mesh_panel(coarse, {.edge_length = out.edge_length});
  if (!made) throw std::runtime_error(made.error().code + ": " + made.error().message);
  out.meshes = {*made, *made};
  return out;
}

std::vector<std::vector<Vec3>> place_flat(const Pattern& pattern, double distance) {
  std::vector<std::vector<Vec3>> out(2);
  for (int p = 0; p < 2; ++p)
    for (const Vec2& q : pattern.meshes[p].nodes) out[p].push_back({q.x(), q.y(), p == 0 ? distance : -distance});
  return out;
}

}  // namespace vitrine::bench
