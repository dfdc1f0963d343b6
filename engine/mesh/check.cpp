// SPDX-License-Identifier: GPL-3.0-or-later
#include "check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "triangulate.hpp"

namespace vitrine::mesh_room {
namespace {

Error bad_setting(const std::string& why) {
  return {Cause::usage, "BAD_SETTING", "The mesh cannot be made: " + why + ".",
          "Use an edge length above zero, in metres, and at least three nodes.", "mesh"};
}

struct Extent {
  Vec2 low, high;
  double length = 0, shortest = 1e300;  ///< [m] of all segments, and of the shortest
};

/// Nothing when every point is finite.
std::optional<Extent> extent_of(std::span<const Vec2> outline, std::span<const Loop> holes) {
  Extent e{outline[0], outline[0]};
  const auto add = [&](std::span<const Vec2> loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (!loop[i].allFinite()) return false;
      e.low = e.low.cwiseMin(loop[i]);
      e.high = e.high.cwiseMax(loop[i]);
      const double length = (loop[(i + 1) % loop.size()] - loop[i]).norm();
      e.length += length;
      e.shortest = std::min(e.shortest, length);
    }
    return true;
  };
  if (!add(outline)) return std::nullopt;
  for (const Loop& hole : holes)
    if (!add(hole)) return std::nullopt;
  return e;
}

bool has_repeated_points(std::span<const Vec2> outline, std::span<const Loop> holes) {
  std::vector<Vec2> sorted(outline.begin(), outline.end());
  for (const Loop& hole : holes) sorted.insert(sorted.end(), hole.begin(), hole.end());
  const auto before = [](const Vec2& a, const Vec2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); };
  std::sort(sorted.begin(), sorted.end(), before);
  return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

}  // namespace

Error degenerate(const std::string& why) {
  return {
      Cause::unusable, "DEGENERATE_OUTLINE", "The panel's outline cannot be meshed: " + why + ".",
      "Check the silhouette and the feature points of this photo; lay the garment flat without folds and retake it.",
      "mesh"};
}

Error too_many(double needed, int allowed) {
  const std::string count = needed < 1e9 ? std::to_string(std::llround(needed)) : "more than 1000000000";
  return {Cause::unusable, "TOO_MANY_NODES",
          "The panel would need about " + count + " nodes, more than the " + std::to_string(allowed) + " allowed.",
          "Use a longer edge length, or check the scale of the garment.", "mesh"};
}

std::optional<Error> check(std::span<const Vec2> outline, std::span<const Loop> holes, const MeshOptions& options) {
  const double h = options.edge_length;
  if (!std::isfinite(h) || h <= 0) return bad_setting("the edge length is not a positive number");
  if (options.max_nodes < 3) return bad_setting("fewer than three nodes are allowed");
  std::size_t points = outline.size();
  if (outline.size() < 3) return degenerate("it has fewer than three points");
  for (const Loop& hole : holes) {
    if (hole.size() < 3) return degenerate("a hole has fewer than three points");
    points += hole.size();
  }
  if (points > static_cast<std::size_t>(options.max_nodes))
    return too_many(static_cast<double>(points), options.max_nodes);

  const std::optional<Extent> extent = extent_of(outline, holes);
  if (!extent) return degenerate("a point is not finite");
  const double box = (extent->high - extent->low).squaredNorm();
  if (!std::isfinite(box) || !std::isfinite(extent->length)) return degenerate("it is too large for metres");
  // What is nearer than rounding can tell apart has no direction.
  if (!(extent->shortest > 1e-12 * std::sqrt(box)) || has_repeated_points(outline, holes))
    return degenerate("a point is repeated");
  double area = std::abs(polygon_area(outline));
  for (const Loop& hole : holes) {
    const double taken = std::abs(polygon_area(hole));
    if (!(taken > 1e-12 * box)) return degenerate("the area of a hole is zero");
    area -= taken;
  }
  if (!(area > 1e-12 * box)) return degenerate("its area is zero");

  // Equilateral triangles fill the area; Euler's formula turns them into nodes.
  const double triangles = area / (0.25 * std::numbers::sqrt3 * h * h), n = static_cast<double>(points);
  const double needed = n + std::max(0.0, 0.5 * (triangles - n + 2));
  if (needed > options.max_nodes) return too_many(needed, options.max_nodes);
  // A thin sliver has little area but a wall of many pieces.
  if (extent->length / h > 4.0 * options.max_nodes) return too_many(extent->length / h, options.max_nodes);
  if (!is_simple_polygon(outline)) return degenerate("it touches or crosses itself");
  for (const Loop& hole : holes)
    if (!is_simple_polygon(hole)) return degenerate("a hole touches or crosses itself");
  return std::nullopt;
}

}  // namespace vitrine::mesh_room
