// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "vitrine/mesh.hpp"

namespace vitrine {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Triangle figures; returns every triangle's edges, smaller index first, sorted (inner edges twice).
std::vector<Edge> measure_triangles(const PanelMesh& mesh, MeshStats& stats) {
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  double sum = 0, smallest = std::numbers::pi;
  std::size_t flat = 0, good = 0;
  for (const Triangle& t : mesh.triangles) {
    std::array<double, 3> length;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[(k + 1) % 3], b = t[(k + 2) % 3];
      length[k] = (mesh.nodes[a] - mesh.nodes[b]).norm();
      edges.emplace_back(std::min(a, b), std::max(a, b));
    }
    std::sort(length.begin(), length.end());
    const double ratio = (length[0] + length[1]) / length[2];
    if (ratio < 1.3) ++flat;
    if (ratio > 1.6) ++good;
    // The smallest angle lies between the two longer edges, opposite to the shortest.
    const double cosine =
        (length[1] * length[1] + length[2] * length[2] - length[0] * length[0]) / (2 * length[1] * length[2]);
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
    smallest = std::min(smallest, angle);
    sum += angle;
  }
  const auto count = static_cast<double>(mesh.triangles.size());
  stats.min_angle_deg = smallest * 180 / std::numbers::pi;
  stats.mean_min_angle_deg = sum / count * 180 / std::numbers::pi;
  stats.flat_share = static_cast<double>(flat) / count;
  stats.good_share = static_cast<double>(good) / count;
  std::sort(edges.begin(), edges.end());
  return edges;
}

}  // namespace

MeshStats measure_mesh(const PanelMesh& mesh) {
  MeshStats stats;
  stats.nodes = static_cast<int>(mesh.nodes.size());
  stats.triangles = static_cast<int>(mesh.triangles.size());
  if (mesh.triangles.empty()) return stats;

  const std::vector<Edge> uses = measure_triangles(mesh, stats);
  std::vector<Edge> edges;
  std::vector<int> valence(mesh.nodes.size(), 0);
  std::vector<char> border(mesh.nodes.size(), 0);
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const auto [a, b] = uses[i];
    edges.push_back(uses[i]);
    ++valence[a];
    ++valence[b];
    if (i + 1 < uses.size() && uses[i + 1] == uses[i])
      ++i;
    else
      border[a] = border[b] = 1;
  }
  int interior = 0, regular = 0;
  for (std::size_t i = 0; i < valence.size(); ++i) {
    if (valence[i] == 0 || border[i]) continue;
    ++interior;
    regular += valence[i] == 6;
  }
  stats.interior_nodes = interior;
  stats.valence6_share = interior > 0 ? static_cast<double>(regular) / interior : 1;

  double sum = 0, variance = 0;
  for (const auto& [a, b] : edges) sum += (mesh.nodes[a] - mesh.nodes[b]).norm();
  const double mean = sum / static_cast<double>(edges.size());
  for (const auto& [a, b] : edges) {
    const double d = (mesh.nodes[a] - mesh.nodes[b]).norm() - mean;
    variance += d * d;
  }
  stats.edge_mean = mean;
  stats.edge_cv = std::sqrt(variance / static_cast<double>(edges.size())) / mean;
  return stats;
}

}  // namespace vitrine
