// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "vitrine/texture.hpp"

namespace vitrine {
namespace {

/// What stands for input that contradicts itself: the writers refuse it by name.
RenderMesh empty_mesh(const char* name) {
  RenderMesh mesh;
  mesh.name = name;
  return mesh;
}

/// Area-weighted normals over groups of vertices that are one point of the surface (sewn nodes, split vertices), so
/// that a seam shades like cloth and not like a crease. Where the triangles around a point cancel out (a fold pressed
/// flat), the neighbours' mean stands in, then up.
std::vector<Vec3> smooth_normals(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles,
                                 const std::vector<std::uint32_t>& group, std::size_t groups) {
  std::vector<Vec3> sum(groups, Vec3::Zero());
  std::vector<double> area(groups, 0.0);
  for (const Triangle& t : triangles) {
    const Vec3 n = (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]);
    for (std::uint32_t v : t) {
      sum[group[v]] += n;
      area[group[v]] += n.norm();
    }
  }
  std::vector<char> good(groups, 0);
  for (std::size_t g = 0; g < groups; ++g)
    if (sum[g].norm() > 1e-6 * area[g] && sum[g].norm() > 1e-18) {
      sum[g].normalize();
      good[g] = 1;
    }
  std::vector<Vec3> borrowed(groups, Vec3::Zero());
  for (const Triangle& t : triangles)
    for (std::uint32_t v : t)
      for (std::uint32_t w : t)
        if (!good[group[v]] && good[group[w]]) borrowed[group[v]] += sum[group[w]];
  for (std::size_t g = 0; g < groups; ++g)
    if (!good[g]) sum[g] = borrowed[g].norm() > 1e-6 ? Vec3(borrowed[g].normalized()) : Vec3::UnitY();
  std::vector<Vec3> normals;
  normals.reserve(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) normals.push_back(sum[group[v]]);
  return normals;
}

}  // namespace

RenderMesh assemble_garment(const Pattern& pattern, const std::vector<std::vector<Vec3>>& positions,
                            const std::vector<std::vector<std::uint32_t>>& welded, Atlas atlas) {
  RenderMesh mesh = empty_mesh("garment");
  const std::size_t panels = pattern.meshes.size();
  if (pattern.panels.size() != panels || positions.size() != panels || welded.size() != panels ||
      atlas.uv.size() != panels)
    return mesh;
  std::vector<std::uint32_t> group;
  for (std::size_t p = 0; p < panels; ++p) {
    const PanelMesh& flat = pattern.meshes[p];
    const std::size_t nodes = flat.nodes.size();
    if (positions[p].size() != nodes || welded[p].size() != nodes || atlas.uv[p].size() != nodes)
      return empty_mesh("garment");
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), positions[p].begin(), positions[p].end());
    mesh.uv.insert(mesh.uv.end(), atlas.uv[p].begin(), atlas.uv[p].end());
    group.insert(group.end(), welded[p].begin(), welded[p].end());
    // The back panel is drawn in the front frame, looked at through the garment: its outer face is the far one.
    const bool turned = pattern.panels[p].side == Side::back;
    for (Triangle t : flat.triangles) {
      if (std::max({t[0], t[1], t[2]}) >= nodes) return empty_mesh("garment");
      if (turned) std::swap(t[1], t[2]);
      for (std::uint32_t& v : t) v += base;
      mesh.triangles.push_back(t);
    }
  }
  // Welded numbers may have gaps; ranks do not, whatever they are.
  std::vector<std::uint32_t> numbers = group;
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  for (std::uint32_t& g : group)
    g = static_cast<std::uint32_t>(std::lower_bound(numbers.begin(), numbers.end(), g) - numbers.begin());
  mesh.normals = smooth_normals(mesh.positions, mesh.triangles, group, numbers.size());
  mesh.texture = std::move(atlas.rgb);
  return mesh;
}

RenderMesh assemble_mannequin(const TriMesh& body) {
  RenderMesh mesh = empty_mesh("mannequin");
  mesh.colour = {0.52, 0.49, 0.45};  // a matte grey-beige that no garment is mistaken for
  mesh.positions = body.vertices;
  mesh.triangles = body.triangles;
  const bool finite =
      std::all_of(body.vertices.begin(), body.vertices.end(), [](const Vec3& p) { return p.allFinite(); });
  const bool inside = std::all_of(body.triangles.begin(), body.triangles.end(), [&](const Triangle& t) {
    return std::max({t[0], t[1], t[2]}) < body.vertices.size();
  });
  if (!finite || !inside) return empty_mesh("mannequin");
  // Imported bodies may be split where their own texture was cut: equal positions are one point.
  std::vector<std::uint32_t> order(body.vertices.size()), group(body.vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto less = [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 &p = body.vertices[a], &q = body.vertices[b];
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return less(a, b) || (!less(b, a) && a < b); });
  std::uint32_t groups = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i && less(order[i - 1], order[i])) ++groups;
    group[order[i]] = groups;
  }
  mesh.normals = smooth_normals(mesh.positions, mesh.triangles, group, order.empty() ? 0 : groups + 1u);
  return mesh;
}

}  // namespace vitrine
