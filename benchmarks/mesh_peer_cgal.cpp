// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/lloyd_optimize_mesh_2.h>

#include <unordered_map>

#include "mesh_bench.hpp"

namespace vitrine::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Structure = CGAL::Triangulation_data_structure_2<CGAL::Delaunay_mesh_vertex_base_2<Kernel>,
                                                       CGAL::Delaunay_mesh_face_base_2<Kernel>>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Cdt>;

/// Refinement stops at edges up to its bound, so that a bound of the target would give too few nodes.
constexpr double kSizeFactor = 1.47;

}  // namespace

PeerRun run_cgal_lloyd(const OutlineCase& outline, int rounds) {
  const double start = cpu_ms();
  Cdt cdt;
  std::vector<Kernel::Point_2> seeds;
  const auto add = [&](const std::vector<Vec2>& loop) {
    std::vector<Cdt::Vertex_handle> handles;
    for (const Vec2& p : loop) handles.push_back(cdt.insert({p.x(), p.y()}));
    for (std::size_t i = 0; i < handles.size(); ++i)
      cdt.insert_constraint(handles[i], handles[(i + 1) % handles.size()]);
  };
  add(outline.outline);
  for (const auto& hole : outline.holes) {
    add(hole);
    Vec2 middle = Vec2::Zero();
    for (const Vec2& p : hole) middle += p / static_cast<double>(hole.size());
    seeds.emplace_back(middle.x(), middle.y());
  }
  CGAL::Delaunay_mesher_2<Cdt, Criteria> mesher(cdt);
  mesher.set_criteria(Criteria(0.125, kSizeFactor * outline.edge_length));
  mesher.set_seeds(seeds.begin(), seeds.end(), false);
  mesher.refine_mesh();
  if (rounds > 0)
    CGAL::lloyd_optimize_mesh_2(cdt, CGAL::parameters::max_iteration_number = rounds,
                                CGAL::parameters::convergence = 0.001, CGAL::parameters::freeze_bound = 0.0);
  PeerRun run;
  run.ms = cpu_ms() - start;
  std::unordered_map<Cdt::Vertex_handle, std::uint32_t> index;
  for (auto v = cdt.finite_vertices_begin(); v != cdt.finite_vertices_end(); ++v) {
    index[v] = static_cast<std::uint32_t>(run.mesh.nodes.size());
    run.mesh.nodes.emplace_back(v->point().x(), v->point().y());
  }
  for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f)
    if (f->is_in_domain())
      run.mesh.triangles.push_back({index.at(f->vertex(0)), index.at(f->vertex(1)), index.at(f->vertex(2))});
  return run;
}

}  // namespace vitrine::bench
