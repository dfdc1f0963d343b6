// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "vitrine/mesh.hpp"

namespace vitrine {

MeshStats measure_mesh(const PanelMesh& mesh) {
  MeshStats stats;
  stats.nodes = static_cast<int>(mesh.nodes.size());
  stats.triangles = static_cast<int>(mesh.triangles.size());
  if (mesh.triangles.empty()) return stats;

  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(3 * mesh.triangles.size());
  double sum = 0, smallest = std::numbers::pi;
  std::size_t flat = 0;
  for (const Triangle& t : mesh.triangles) {
    std::array<double, 3> length;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[(k + 1) % 3], b = t[(k + 2) % 3];
      length[k] = (mesh.nodes[a] - mesh.nodes[b]).norm();
      edges.emplace_back(std::min(a, b), std::max(a, b));
    }
    std::sort(length.begin(), length.end());
    if (length[0] + length[1] < 1.3 * length[2]) ++flat;
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

  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  double mean = 0, variance = 0;
  for (const auto& [a, b] : edges) mean += (mesh.nodes[a] - mesh.nodes[b]).norm();
  mean /= static_cast<double>(edges.size());
  for (const auto& [a, b] : edges) {
    const double d = (mesh.nodes[a] - mesh.nodes[b]).norm() - mean;
    variance += d * d;
  }
  stats.edge_cv = std::sqrt(variance / static_cast<double>(edges.size())) / mean;
  return stats;
}

}  // namespace vitrine
