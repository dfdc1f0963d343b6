// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "magnets.hpp"
#include "polish.hpp"
#include "rules.hpp"
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
  const double needed = static_cast<double>(outline.size()) + ideal_interior_count(area, outline.size(), h);
  if (needed > options.max_nodes) return too_many(needed, options.max_nodes);
  // A thin sliver has little area but a wall of many magnets.
  if (length / h > 4.0 * options.max_nodes) return too_many(length / h, options.max_nodes);
  if (!is_simple_polygon(outline)) return degenerate("it touches or crosses itself");
  return true;
}

/// One number for "better": flat triangles weigh most, then the angles, then even edges.
double score(const MeshStats& s) {
  return s.mean_min_angle_deg + 0.2 * s.min_angle_deg - 300 * s.flat_share - 40 * s.edge_cv;
}

/// The best mesh seen so far; every step is free to try, none can make the result worse.
class Best {
 public:
  bool offer(const PanelMesh& mesh) {
    const double now = score(measure_mesh(mesh));
    if (!mesh_.triangles.empty() && now <= score_) return false;
    mesh_ = mesh;
    score_ = now;
    return true;
  }
  bool empty() const { return mesh_.triangles.empty(); }
  const PanelMesh& mesh() const { return mesh_; }

 private:
  PanelMesh mesh_;
  double score_ = 0;
};

/// Lattice nodes, half settled: of the two lattices that are symmetric about the middle (a node on it, or a gap) the
/// one that goes better with the outline's own nodes.
PanelMesh start(std::span<const Vec2> outline, const Wall& wall, double h, int sweeps) {
  Best best;
  for (double shift : {0.0, 0.5}) {
    PanelMesh mesh;
    mesh.nodes.assign(outline.begin(), outline.end());
    const std::vector<Vec2> magnets = insert_magnets(outline, wall, h, shift);
    mesh.nodes.insert(mesh.nodes.end(), magnets.begin(), magnets.end());
    settle(mesh.nodes, outline.size(), wall, h, sweeps);
    mesh.triangles = triangulate(mesh.nodes, outline.size());
    if (!mesh.triangles.empty()) best.offer(mesh);
  }
  return best.mesh();
}

}  // namespace

Result<PanelMesh> mesh_panel(std::span<const Vec2> outline, const MeshOptions& options) {
  if (const auto ok = check(outline, options); !ok) return ok.error();
  const double h = options.edge_length;
  const std::size_t n = outline.size();
  const auto max_nodes = static_cast<std::size_t>(options.max_nodes);
  const int portion = std::max(0, options.max_sweeps) / 4;
  const Wall wall(outline, h);

  constexpr int kRounds = 12, kPatience = 3, kPolishes = 4;
  PanelMesh mesh = start(outline, wall, h, portion);
  Best best;
  int worse = 0;
  for (int round = 0; round < kRounds && worse < kPatience && !mesh.triangles.empty(); ++round) {
    worse = best.offer(mesh) ? 0 : worse + 1;
    const int changes = apply_edge_ratio_rules(mesh.nodes, n, mesh.triangles, wall, h, max_nodes);
    if (changes == 0 && round > 0) break;
    settle(mesh.nodes, n, wall, h, portion);
    mesh.triangles = triangulate(mesh.nodes, n);
  }
  if (best.empty()) return degenerate("its points are too close to its own segments to triangulate");

  mesh = best.mesh();
  for (int i = 0; i < kPolishes && polish(mesh.nodes, n, mesh.triangles, wall, h) > 0; ++i) {
    mesh.triangles = triangulate(mesh.nodes, n);
    if (mesh.triangles.empty() || !best.offer(mesh)) break;
  }
  return best.mesh();
}

}  // namespace vitrine
