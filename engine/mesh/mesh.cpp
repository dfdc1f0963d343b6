// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "boundary.hpp"
#include "check.hpp"
#include "insert.hpp"
#include "lattice.hpp"
#include "polish.hpp"
#include "rules.hpp"
#include "settle.hpp"
#include "sheet.hpp"
#include "sizing.hpp"
#include "triangulate.hpp"
#include "wall.hpp"

namespace vitrine {
namespace {

using namespace mesh_room;

/// How far the wall's disorder is allowed to reach, in target edges: deeper nodes keep their place in the lattice.
constexpr double kRingDepth = 3.7;
constexpr int kRuleRounds = 4;  ///< of the edge-ratio rules

/// Whether the triangles are all that lies between the loops: by number (Euler) and by area.
bool covers(const Boundary& boundary, const std::vector<Vec2>& nodes, const std::vector<Triangle>& triangles) {
  const std::size_t holes = boundary.loop_count() - 1;
  if (triangles.size() + boundary.size() + 2 != 2 * (nodes.size() + holes)) return false;
  double area = 0;
  for (const Triangle& t : triangles) {
    const Vec2 u = nodes[t[1]] - nodes[t[0]], v = nodes[t[2]] - nodes[t[0]];
    area += 0.5 * (u.x() * v.y() - u.y() * v.x());
  }
  return std::abs(area - boundary.area()) <= 1e-9 * (boundary.high() - boundary.low()).squaredNorm();
}

/// The nodes that will move, with enough around them to move among, triangulated.
Result<Sheet> make_sheet(const Boundary& boundary, const Sizing& sizing, const Inserted& inserted) {
  std::vector<Vec2> nodes = boundary.nodes();
  nodes.insert(nodes.end(), inserted.ring.begin(), inserted.ring.end());
  nodes.insert(nodes.end(), inserted.rim.begin(), inserted.rim.end());
  const std::vector<Triangle> triangles = triangulate(nodes, boundary);
  if (!covers(boundary, nodes, triangles))
    return degenerate(boundary.loop_count() > 1
                          ? "a hole touches the outline or another hole, or does not lie inside the outline"
                          : "its points are too close to its own segments to triangulate");
  std::vector<double> sizes(nodes.size(), sizing.target());
  if (!sizing.uniform())
    std::transform(nodes.begin(), nodes.end(), sizes.begin(), [&](const Vec2& p) { return sizing.at(p); });
  return Sheet(std::move(nodes), std::move(sizes), boundary.size(), triangles);
}

/// Settled, by the rules, and polished.
void relax(Sheet& sheet, const Ground& ground, std::vector<std::uint32_t> ring, int sweeps) {
  settle(sheet, ring, sweeps);
  for (int round = 0; round < kRuleRounds && apply_edge_ratio_rules(sheet, ground, ring) > 0; ++round) {
    if (!ground.sizing.uniform())
      for (const std::uint32_t i : ring) sheet.set_size(i, ground.sizing.at(sheet.at(i)));
    settle(sheet, ring, sweeps / 2);
  }
  relieve_sharp_triangles(sheet, ring);
  polish(sheet, ring);
}

}  // namespace

Result<PanelMesh> mesh_panel(std::span<const Vec2> outline, const MeshOptions& options,
                             std::span<const std::vector<Vec2>> holes) {
  if (auto error = check(outline, holes, options)) return *std::move(error);
  const Boundary boundary(outline, holes);
  const Wall wall(boundary, options.edge_length);
  const Sizing sizing(boundary, wall, options.edge_length);
  const Ground ground{boundary, wall, sizing};
  const auto max_nodes = static_cast<std::size_t>(options.max_nodes);
  const Inserted inserted = insert_nodes(ground, fit_lattice(boundary, options.edge_length), kRingDepth, max_nodes);

  auto sheet = make_sheet(boundary, sizing, inserted);
  if (!sheet) return sheet.error();
  std::vector<std::uint32_t> ring(inserted.ring.size());
  std::iota(ring.begin(), ring.end(), static_cast<std::uint32_t>(boundary.size()));
  relax(*sheet, ground, std::move(ring), std::max(0, options.max_sweeps));

  PanelMesh mesh;
  mesh.nodes = sheet->nodes();
  mesh.nodes.insert(mesh.nodes.end(), inserted.deep.begin(), inserted.deep.end());
  if (mesh.nodes.size() > max_nodes) return too_many(static_cast<double>(mesh.nodes.size()), options.max_nodes);
  mesh.triangles = triangulate(mesh.nodes, boundary);
  if (!covers(boundary, mesh.nodes, mesh.triangles))
    return degenerate("its points are too close to its own segments to triangulate");
  return mesh;
}

}  // namespace vitrine
