// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_check.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace vitrine::body {

MeshState inspect(const TriMesh& mesh) {
  MeshState state;
  const std::size_t n = mesh.vertices.size();
  for (const Vec3& v : mesh.vertices) state.finite = state.finite && v.allFinite();
  for (const Triangle& t : mesh.triangles)
    for (std::uint32_t v : t) state.valid_indices = state.valid_indices && v < n;
  if (!state.valid_indices) return state;
  std::vector<std::uint64_t> edges;  // low vertex, high vertex, direction in the last bit
  edges.reserve(mesh.triangles.size() * 3);
  for (const Triangle& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const std::uint64_t a = t[i], b = t[(i + 1) % 3];
      edges.push_back(a < b ? (a << 32 | b << 1) : (b << 32 | a << 1 | 1));
    }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i;
    while (j < edges.size() && edges[j] >> 1 == edges[i] >> 1) ++j;
    if (j - i == 1) ++state.open_edges;
    if (j - i > 2) ++state.crowded_edges;
    if (j - i == 2 && edges[i] == edges[i + 1]) ++state.turned_edges;
    if (!state.has_fault && !state.closed()) {
      state.has_fault = true;
      state.fault_from = static_cast<std::uint32_t>(edges[i] >> 32);
      state.fault_to = static_cast<std::uint32_t>(edges[i] >> 1 & 0x7fffffffU);
    }
    i = j;
  }
  const std::vector<int> piece = pieces(mesh);
  state.parts = static_cast<std::size_t>(piece.empty() ? 0 : *std::max_element(piece.begin(), piece.end()) + 1);
  return state;
}

double signed_volume(const TriMesh& mesh) {
  double six = 0;
  for (const Triangle& t : mesh.triangles)
    six += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  return six / 6;
}

double smallest_angle(const TriMesh& mesh) {
  double sharpest = -1;  // the largest cosine
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3& at = mesh.vertices[t[k]];
      const Vec3 a = mesh.vertices[t[(k + 1) % 3]] - at, b = mesh.vertices[t[(k + 2) % 3]] - at;
      sharpest = std::max(sharpest, a.dot(b) / std::max(a.norm() * b.norm(), 1e-300));
    }
  return std::acos(std::clamp(sharpest, -1.0, 1.0));
}

std::vector<int> pieces(const TriMesh& mesh) {
  const std::size_t n = mesh.vertices.size();
  std::vector<std::size_t> parent(n);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&parent](std::size_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  std::vector<bool> used(n, false);
  for (const Triangle& t : mesh.triangles) {
    for (std::uint32_t v : t) used[v] = true;
    for (int i = 1; i < 3; ++i) {
      const std::size_t a = root(t[0]), b = root(t[i]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<int> piece(n, -1), number(n, -1);
  int count = 0;
  for (std::size_t v = 0; v < n; ++v) {
    if (!used[v]) continue;
    int& id = number[root(v)];
    if (id < 0) id = count++;
    piece[v] = id;
  }
  return piece;
}

}  // namespace vitrine::body
