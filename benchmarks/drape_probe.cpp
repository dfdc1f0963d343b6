// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "drape_bench.hpp"

namespace vitrine::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Point point(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

Mesh to_cgal(const TriMesh& mesh) {
  Mesh out;
  std::vector<Mesh::Vertex_index> v;
  for (const Vec3& p : mesh.vertices) v.push_back(out.add_vertex(point(p)));
  for (const Triangle& t : mesh.triangles)
    if (out.add_face(v[t[0]], v[t[1]], v[t[2]]) == Mesh::null_face())
      throw std::runtime_error("body.obj: not a surface");
  return out;
}

struct Strain {
  double mean_of_size = 0, most = 0, least = 0, p99 = 0;
};

/// Over the edges of both panels, each counted once.
Strain strain_of(const Pattern& pattern, const std::vector<std::vector<Vec3>>& x) {
  std::vector<double> all;
  for (std::size_t p = 0; p < 2; ++p) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const Triangle& t : pattern.meshes[p].triangles)
      for (int e = 0; e < 3; ++e) edges.insert(std::minmax(t[e], t[(e + 1) % 3]));
    for (const auto& [a, b] : edges)
      all.push_back((x[p][a] - x[p][b]).norm() / (pattern.meshes[p].nodes[a] - pattern.meshes[p].nodes[b]).norm() - 1);
  }
  std::sort(all.begin(), all.end());
  Strain s{0, all.back(), all.front(), all[static_cast<std::size_t>(0.99 * static_cast<double>(all.size() - 1))]};
  for (const double e : all) s.mean_of_size += std::abs(e) / static_cast<double>(all.size());
  return s;
}

}  // namespace

nlohmann::ordered_json drape_figures(const DrapeCase& input, const std::vector<std::vector<Vec3>>& x) {
  const Mesh body = to_cgal(input.body);
  Tree tree(faces(body).first, faces(body).second, body);
  tree.accelerate_distance_queries();
  const CGAL::Side_of_triangle_mesh<Mesh, Kernel> side(tree);
  int inside = 0, crossing = 0;
  double deepest = 0, top = -1e9, bottom = 1e9;
  std::size_t nodes = 0, triangles = 0;
  for (std::size_t p = 0; p < 2; ++p) {
    for (const Vec3& q : x[p]) {
      top = std::max(top, q.y());
      bottom = std::min(bottom, q.y());
      if (side(point(q)) != CGAL::ON_BOUNDED_SIDE) continue;
      ++inside;
      deepest = std::max(deepest, std::sqrt(tree.squared_distance(point(q))));
    }
    for (const Triangle& t : input.pattern.meshes[p].triangles)
      crossing += tree.do_intersect(Kernel::Triangle_3(point(x[p][t[0]]), point(x[p][t[1]]), point(x[p][t[2]])));
    nodes += x[p].size();
    triangles += input.pattern.meshes[p].triangles.size();
  }
  double gap_sum = 0, gap_most = 0;
  for (const NodePair& q : input.pattern.pairs) {
    const double gap = (x[q.panel_a][q.node_a] - x[q.panel_b][q.node_b]).norm();
    gap_sum += gap;
    gap_most = std::max(gap_most, gap);
  }
  const Strain s = strain_of(input.pattern, x);
  return {{"verts", nodes},
          {"tris", triangles},
          {"pairs", input.pattern.pairs.size()},
          {"gap_mean_mm", 1e3 * gap_sum / static_cast<double>(input.pattern.pairs.size())},
          {"gap_max_mm", 1e3 * gap_most},
          {"inside", inside},
          {"inside_pct", 100.0 * inside / static_cast<double>(nodes)},
          {"depth_max_mm", 1e3 * deepest},
          {"tri_cross_body", crossing},
          {"strain_abs_mean_pct", 100 * s.mean_of_size},
          {"strain_max_pct", 100 * s.most},
          {"strain_min_pct", 100 * s.least},
          {"strain_p99_pct", 100 * s.p99},
          {"z_top", top},
          {"z_bot", bottom}};
}

}  // namespace vitrine::bench
