// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "boundary.hpp"
#include "insert.hpp"
#include "lattice.hpp"
#include "rules.hpp"
#include "settle.hpp"
#include "sheet.hpp"
#include "sizing.hpp"
#include "triangulate.hpp"
#include "wall.hpp"

namespace vitrine {
namespace {

using namespace mesh_room;

Error degenerate(const std::string& why) {
  return {
      Cause::unusable, "DEGENERATE_OUTLINE", "The panel's outline cannot be meshed: " + why + ".",
      "Check the silhouette and the feature points of this photo; lay the garment flat without folds and retake it.",
      "mesh"};
}

Error bad_setting(const std::string& why) {
  return {Cause::usage, "BAD_SETTING", "The mesh cannot be made: " + why + ".",
          "Use an edge length above zero, in metres, and at least three nodes.", "mesh"};
}

Error too_many(double needed, int allowed) {
  const std::string count = needed < 1e9 ? std::to_string(std::llround(needed)) : "more than 1000000000";
  return {Cause::unusable, "TOO_MANY_NODES",
          "The panel would need about " + count + " nodes, more than the " + std::to_string(allowed) + " allowed.",
          "Use a longer edge length, or check the scale of the garment.", "mesh"};
}

bool has_repeated_points(std::span<const Vec2> outline) {
  std::vector<Vec2> sorted(outline.begin(), outline.end());
  const auto before = [](const Vec2& a, const Vec2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); };
  std::sort(sorted.begin(), sorted.end(), before);
  return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

/// Sizes are checked before anything is allocated by them; the outline comes from a stranger's photo.
Result<bool> check(std::span<const Vec2> outline, const MeshOptions& options) {
  const double h = options.edge_length;
  if (!std::isfinite(h) || h <= 0) return bad_setting("the edge length is not a positive number");
  if (options.max_nodes < 3) return bad_setting("fewer than three nodes are allowed");
  if (outline.size() < 3) return degenerate("it has fewer than three points");
  if (outline.size() > static_cast<std::size_t>(options.max_nodes))
    return too_many(static_cast<double>(outline.size()), options.max_nodes);
  Vec2 low = outline[0], high = outline[0];
  double length = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    if (!outline[i].allFinite()) return degenerate("a point is not finite");
    low = low.cwiseMin(outline[i]);
    high = high.cwiseMax(outline[i]);
    length += (outline[(i + 1) % outline.size()] - outline[i]).norm();
  }
  const double box = (high - low).squaredNorm();
  if (!std::isfinite(box) || !std::isfinite(length)) return degenerate("it is too large for metres");
  if (has_repeated_points(outline)) return degenerate("a point is repeated");
  const double area = std::abs(polygon_area(outline));
  if (!(area > 1e-12 * box)) return degenerate("its area is zero");
  const double needed = static_cast<double>(outline.size()) + 0.5 * std::max(0.0, area / (0.4330127 * h * h) - static_cast<double>(outline.size()) + 2);
  if (needed > options.max_nodes) return too_many(needed, options.max_nodes);
  // A thin sliver has little area but a wall of many magnets.
  if (length / h > 4.0 * options.max_nodes) return too_many(length / h, options.max_nodes);
  if (!is_simple_polygon(outline)) return degenerate("it touches or crosses itself");
  return true;
}

double param(const char* n, double d) { const char* s = std::getenv(n); return s ? std::atof(s) : d; }
}  // namespace

Result<PanelMesh> mesh_panel(std::span<const Vec2> outline, const MeshOptions& options,
                             std::span<const std::vector<Vec2>> holes) {
  if (const auto ok = check(outline, options); !ok) return ok.error();
  const double h = options.edge_length;
  const Boundary boundary(outline, holes);
  const Wall wall(boundary, h);
  const Sizing sizing(boundary, h);
  const Ground ground{boundary, wall, sizing};
  const Lattice lattice = fit_lattice(boundary, h);
  const Inserted inserted = insert_nodes(ground, lattice, param("DEPTH", 3.7), options.max_nodes);
  const std::size_t total = boundary.size() + inserted.ring.size() + inserted.rim.size() + inserted.deep.size();
  if (total > static_cast<std::size_t>(options.max_nodes)) return too_many(static_cast<double>(total), options.max_nodes);
  std::vector<Vec2> nodes = boundary.nodes();
  nodes.insert(nodes.end(), inserted.ring.begin(), inserted.ring.end());
  std::vector<std::uint32_t> ring(inserted.ring.size());
  std::iota(ring.begin(), ring.end(), static_cast<std::uint32_t>(boundary.size()));
  nodes.insert(nodes.end(), inserted.rim.begin(), inserted.rim.end());
  const auto first = triangulate(nodes, boundary);
  if (first.empty()) return degenerate("its points are too close to its own segments to triangulate");
  std::vector<double> sizes(nodes.size(), h);
  if (!sizing.uniform()) for (std::size_t i = 0; i < nodes.size(); ++i) sizes[i] = sizing.at(nodes[i]);
  Sheet sheet(std::move(nodes), std::move(sizes), boundary.size(), first);
  int sw = settle(sheet, ring, (int)param("SWEEPS",12));
  for (int r = 0; r < (int)param("ROUNDS", 4); ++r) {
    int ch = apply_edge_ratio_rules(sheet, ground, ring);
  if(getenv("VERB")) fprintf(stderr,"round %d changes %d\n", r, ch);
    if (ch == 0) break;
    if (!sizing.uniform()) for (auto i : ring) sheet.set_size(i, sizing.at(sheet.at(i)));
    settle(sheet, ring, (int)param("SW2",6));
  }
  polish(sheet, ring, (int)param("POLISH",6));
  if(getenv("VERB")) fprintf(stderr,"axis %.3f %.3f sweeps %d ring %zu deep %zu of %zu\n", lattice.axis.x(), lattice.axis.y(), sw,inserted.ring.size(), inserted.deep.size(), ring.size());
  PanelMesh mesh;
  mesh.nodes = sheet.nodes();
  mesh.nodes.insert(mesh.nodes.end(), inserted.deep.begin(), inserted.deep.end());
  mesh.triangles = triangulate(mesh.nodes, boundary);
  if (mesh.triangles.empty()) return degenerate("its points are too close to its own segments to triangulate");
  return mesh;
}

}  // namespace vitrine
