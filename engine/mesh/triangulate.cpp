// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulate.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace vitrine::mesh_room {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
// The index rides in the vertex: a map keyed by handles would follow memory addresses, which differ between runs.
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceInfoBase = CGAL::Triangulation_face_base_with_info_2<int, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel, FaceInfoBase>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;

/// Faces are inside when an odd number of loops lies between them and the infinite face: info 1 inside, 0 outside.
void mark_inside(Cdt& cdt) {
  for (auto face : cdt.all_face_handles()) face->info() = -1;
  std::vector<Cdt::Face_handle> now{cdt.infinite_face()}, beyond;
  for (int inside = 0; !now.empty(); inside = 1 - inside) {
    while (!now.empty()) {
      const Cdt::Face_handle face = now.back();
      now.pop_back();
      if (face->info() >= 0) continue;
      face->info() = inside;
      for (int i = 0; i < 3; ++i)
        if (face->neighbor(i)->info() < 0) (face->is_constrained(i) ? beyond : now).push_back(face->neighbor(i));
    }
    std::swap(now, beyond);
  }
}

}  // namespace

bool is_simple_polygon(std::span<const Vec2> outline) {
  std::vector<Point> points;
  points.reserve(outline.size());
  for (const Vec2& p : outline) points.emplace_back(p.x(), p.y());
  return CGAL::is_simple_2(points.begin(), points.end(), Kernel());
}

std::vector<Triangle> triangulate(std::span<const Vec2> nodes, const Boundary& boundary) {
  const std::size_t outline_size = boundary.size();
  std::vector<std::pair<Point, std::uint32_t>> points;
  points.reserve(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    points.emplace_back(Point(nodes[i].x(), nodes[i].y()), static_cast<std::uint32_t>(i));

  std::vector<Triangle> triangles;
  try {
    Cdt cdt;
    cdt.insert(points.begin(), points.end());
    if (cdt.number_of_vertices() != nodes.size()) return {};
    std::vector<Cdt::Vertex_handle> handle(outline_size);
    for (auto v : cdt.finite_vertex_handles())
      if (v->info() < outline_size) handle[v->info()] = v;
    for (std::size_t i = 0; i < outline_size; ++i) cdt.insert_constraint(handle[i], handle[boundary.next(i)]);
    if (cdt.number_of_vertices() != nodes.size()) return {};
    mark_inside(cdt);
    triangles.reserve(2 * nodes.size());
    for (auto face : cdt.finite_face_handles()) {
      if (face->info() != 1) continue;
      Triangle t{face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      triangles.push_back(t);
    }
  } catch (const std::exception&) {  // CGAL's preconditions and crossing constraints
    return {};
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace vitrine::mesh_room
