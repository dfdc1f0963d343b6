// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "vitrine/accuracy.hpp"

namespace vitrine {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Soup = std::vector<Kernel::Triangle_3>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Soup::const_iterator>>>;

constexpr double no_area = 1e-14;  // [m^2]

Kernel::Point_3 point(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

double area_of(const TriMesh& mesh, const Triangle& t) {
  const Vec3& a = mesh.vertices[t[0]];
  return 0.5 * (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm();
}

/// Places that are uniform over the area: equal steps along the triangles laid end to end, and within each a point of
/// the R2 sequence (Roberts 2018), folded onto the triangle.
std::vector<Vec3> sample(const TriMesh& mesh, int count) {
  double total = 0;
  for (const Triangle& t : mesh.triangles) total += area_of(mesh, t);
  std::vector<Vec3> samples;
  if (!(total > 0)) return samples;
  samples.reserve(static_cast<std::size_t>(count));
  const double step = total / count, g = 1.32471795724474602596;
  double passed = 0, next = 0.5 * step;
  for (const Triangle& t : mesh.triangles) {
    passed += area_of(mesh, t);
    for (; next < passed; next += step) {
      const auto i = static_cast<double>(samples.size() + 1);
      double u = std::fmod(0.5 + i / g, 1.0), v = std::fmod(0.5 + i / (g * g), 1.0);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      samples.push_back((1 - u - v) * mesh.vertices[t[0]] + u * mesh.vertices[t[1]] + v * mesh.vertices[t[2]]);
    }
  }
  return samples;
}

void add_distances(const std::vector<Vec3>& from, const TriMesh& to, std::vector<double>& out) {
  Soup soup;
  soup.reserve(to.triangles.size());
  for (const Triangle& t : to.triangles)
    if (area_of(to, t) > no_area)
      soup.emplace_back(point(to.vertices[t[0]]), point(to.vertices[t[1]]), point(to.vertices[t[2]]));
  if (soup.empty()) return;
  Tree tree(soup.cbegin(), soup.cend());
  // Samples follow the triangles, so that the last nearest place is a good first guess for the next one.
  Kernel::Point_3 hint = soup.front().vertex(0);
  for (const Vec3& p : from) {
    hint = tree.closest_point(point(p), hint);
    out.push_back((Vec3(hint.x(), hint.y(), hint.z()) - p).norm());
  }
}

}  // namespace

TriMesh garment_surface(const Pattern& pattern, const Drape& drape) {
  TriMesh surface;
  for (std::size_t p = 0; p < drape.welded.size(); ++p)
    for (std::size_t i = 0; i < drape.welded[p].size(); ++i) {
      const std::uint32_t n = drape.welded[p][i];
      if (n >= surface.vertices.size()) surface.vertices.resize(n + 1, Vec3::Zero());
      surface.vertices[n] = drape.positions[p][i];
    }
  for (std::size_t p = 0; p < drape.welded.size(); ++p)
    for (const Triangle& t : pattern.meshes[p].triangles) {
      const auto& w = drape.welded[p];
      // The back panel's triangles are counter-clockwise seen from the front.
      surface.triangles.push_back(p == 1 ? Triangle{w[t[0]], w[t[2]], w[t[1]]} : Triangle{w[t[0]], w[t[1]], w[t[2]]});
    }
  return surface;
}

SurfaceDistance surface_distance(const TriMesh& a, const TriMesh& b, int samples) {
  std::vector<double> all;
  add_distances(sample(a, samples), b, all);
  add_distances(sample(b, samples), a, all);
  SurfaceDistance d;
  if (all.empty()) return d;
  double sum = 0;
  for (const double v : all) sum += v;
  std::sort(all.begin(), all.end());
  d.mean_mm = 1000 * sum / static_cast<double>(all.size());
  d.p95_mm = 1000 * all[static_cast<std::size_t>(0.95 * static_cast<double>(all.size() - 1))];
  d.max_mm = 1000 * all.back();
  return d;
}

}  // namespace vitrine
