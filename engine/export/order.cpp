// SPDX-License-Identifier: GPL-3.0-or-later
#include "order.hpp"

#include <meshoptimizer.h>

#include <cstring>

namespace vitrine {
namespace {

template <class T>
std::vector<T> moved(const std::vector<T>& values, const std::vector<unsigned>& place, std::size_t count) {
  if (values.empty()) return {};
  std::vector<T> result(count);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (place[i] != ~0u) result[place[i]] = values[i];
  return result;
}

}  // namespace

RenderMesh ordered_for_caches(const RenderMesh& mesh) {
  std::vector<unsigned> indices;
  indices.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
  meshopt_optimizeVertexCache(indices.data(), indices.data(), indices.size(), mesh.positions.size());
  std::vector<unsigned> place(mesh.positions.size());
  const std::size_t used =
      meshopt_optimizeVertexFetchRemap(place.data(), indices.data(), indices.size(), mesh.positions.size());
  RenderMesh out;
  out.name = mesh.name;
  out.colour = mesh.colour;
  out.positions = moved(mesh.positions, place, used);
  out.normals = moved(mesh.normals, place, used);
  out.uv = moved(mesh.uv, place, used);
  out.shade = moved(mesh.shade, place, used);
  out.triangles.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < out.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) out.triangles[t][k] = place[indices[3 * t + k]];
  return out;
}

}  // namespace vitrine
