// SPDX-License-Identifier: GPL-3.0-or-later
#include "check.hpp"

#include <algorithm>
#include <cmath>

namespace vitrine {
namespace {

// Kilometres are as wrong as infinity, and both overflow a viewer's floats when squared.
constexpr double kLargestCoordinate = 1e6;

template <class V>
bool sane(const std::vector<V>& values, double limit) {
  return std::all_of(values.begin(), values.end(),
                     [&](const V& v) { return v.allFinite() && v.cwiseAbs().maxCoeff() <= limit; });
}

const char* fault(const RenderMesh& m) {
  if (m.name.empty()) return "has no name";
  if (m.positions.empty() || m.triangles.empty()) return "is empty";
  if (m.positions.size() >= 0xffffffffu) return "has too many vertices";
  if (m.normals.size() != m.positions.size()) return "has not one normal per vertex";
  if (!m.uv.empty() && m.uv.size() != m.positions.size()) return "has not one texture coordinate per vertex";
  if (!m.texture.empty() && m.uv.empty()) return "has a texture but no texture coordinates";
  if (!m.shade.empty() && m.shade.size() != m.positions.size()) return "has not one shade per vertex";
  if (!m.occlusion.empty() && m.texture.empty()) return "has an occlusion picture but no texture";
  if (!sane(m.positions, kLargestCoordinate)) return "has a vertex that is not a place";
  if (!sane(m.uv, 1e3)) return "has a texture coordinate that is not a number";
  for (const Vec3& n : m.normals)
    if (!n.allFinite() || std::abs(n.norm() - 1.0) > 1e-4) return "has a normal that is not of unit length";
  for (const Triangle& t : m.triangles)
    if (std::max({t[0], t[1], t[2]}) >= m.positions.size()) return "has a triangle without vertices";
  for (double c : m.colour)
    if (!(c >= 0 && c <= 1)) return "has a colour out of range";
  return nullptr;
}

}  // namespace

std::optional<Error> check_meshes(std::span<const RenderMesh> meshes) {
  const auto bad = [](const std::string& message) {
    return Error{Cause::internal, "BAD_MESH", message, "Report this with the photos that caused it.", "export"};
  };
  if (meshes.empty()) return bad("There is no mesh to write.");
  for (const RenderMesh& mesh : meshes)
    if (const char* what = fault(mesh)) return bad("Mesh \"" + mesh.name + "\" " + what + ".");
  return std::nullopt;
}

}  // namespace vitrine
