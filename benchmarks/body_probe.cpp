// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_probe.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_slicer.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/convex_hull_2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <random>

namespace vitrine::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Curve = std::vector<Point>;

Point point(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

Mesh to_cgal(const TriMesh& mesh) {
  Mesh out;
  std::vector<Mesh::Vertex_index> v;
  for (const Vec3& p : mesh.vertices) v.push_back(out.add_vertex(point(p)));
  for (const Triangle& t : mesh.triangles)
    if (out.add_face(v[t[0]], v[t[1]], v[t[2]]) == Mesh::null_face()) return {};
  return out;
}

struct Cut {
  double tape = 0, low_x = 0, high_x = 0, middle = 0;  ///< middle: smallest |x|
};

std::vector<Cut> cut(const Mesh& mesh, const Vec3& at, const Vec3& normal) {
  const CGAL::Polygon_mesh_slicer<Mesh, Kernel> slicer(mesh);
  std::vector<Curve> curves;
  slicer(Kernel::Plane_3(point(at), Kernel::Vector_3(normal.x(), normal.y(), normal.z())), std::back_inserter(curves));
  const Vec3 u = normal.cross(std::abs(normal.y()) < 0.9 ? Vec3(0, 1, 0) : Vec3(1, 0, 0)).normalized();
  const Vec3 w = normal.cross(u).normalized();
  std::vector<Cut> cuts;
  for (const Curve& curve : curves) {
    Cut c;
    c.low_x = 1e9;
    c.high_x = -1e9;
    std::vector<Kernel::Point_2> flat, hull;
    for (const Point& q : curve) {
      const Vec3 p = Vec3(q.x(), q.y(), q.z()) - at;
      flat.emplace_back(p.dot(u), p.dot(w));
      c.low_x = std::min(c.low_x, q.x());
      c.high_x = std::max(c.high_x, q.x());
    }
    CGAL::convex_hull_2(flat.begin(), flat.end(), std::back_inserter(hull));
    for (std::size_t i = 0; i < hull.size(); ++i)
      c.tape += std::sqrt(CGAL::squared_distance(hull[i], hull[(i + 1) % hull.size()]));
    cuts.push_back(c);
  }
  return cuts;
}

/// The trunk's girth: the longest tape among the curves that hold the middle.
double trunk(const Mesh& mesh, const Vec3& at, const Vec3& normal) {
  double tape = 0;
  for (const Cut& c : cut(mesh, at, normal))
    if (c.low_x < 0 && c.high_x > 0) tape = std::max(tape, c.tape);
  return tape;
}

double crotch(const Mesh& mesh, double height) {
  double apart = 0.3 * height, joined = 0.58 * height;
  for (int i = 0; i < 24; ++i) {
    const double y = 0.5 * (apart + joined);
    (trunk(mesh, {0, y, 0}, {0, 1, 0}) > 0 ? joined : apart) = y;
  }
  return 0.5 * (apart + joined);
}

double corner_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = (b - a).normalized(), v = (c - a).normalized();
  return std::acos(std::clamp(u.dot(v), -1.0, 1.0)) * 57.29577951308232;
}

double seconds_since(std::clock_t start) {
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace

BodyProbe probe_body(const Mannequin& body) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  BodyProbe r;
  r.triangles = body.mesh.triangles.size();
  const Mesh mesh = to_cgal(body.mesh);
  bool finite = true;
  double low = 1e9, high = -1e9;
  for (const Vec3& v : body.mesh.vertices) {
    finite = finite && v.allFinite();
    low = std::min(low, v.y());
    high = std::max(high, v.y());
  }
  for (const auto& [name, at] : body.landmarks) finite = finite && at.allFinite();
  r.sound = finite && mesh.number_of_faces() == body.mesh.triangles.size() && CGAL::is_closed(mesh) &&
            pmp::does_bound_a_volume(mesh);
  if (!r.sound) return r;
  r.crosses_itself = pmp::does_self_intersect(mesh);
  r.smallest_angle = 180;
  for (const Triangle& t : body.mesh.triangles)
    for (int k = 0; k < 3; ++k)
      r.smallest_angle =
          std::min(r.smallest_angle, corner_angle(body.mesh.vertices[t[k]], body.mesh.vertices[t[(k + 1) % 3]],
                                                  body.mesh.vertices[t[(k + 2) % 3]]));
  const auto& mark = body.landmarks;
  const Vec3 up(0, 1, 0);
  const auto level = [&](const char* name) { return trunk(mesh, mark.at(name), up); };
  r.height = high - low;
  r.bust = level("bust_right");
  r.under_bust = level("under_bust");
  r.waist = level("waist");
  r.hip = level("hip");
  r.inside_leg = crotch(mesh, r.height);
  const Vec3 c7 = mark.at("neck_back"), pit = mark.at("neck_front");
  r.neck_base = trunk(mesh, c7, (pit - c7).cross(Vec3(1, 0, 0)).normalized());
  for (const char* side : {"_left", "_right"}) {
    const Vec3 shoulder = mark.at(std::string("shoulder") + side), elbow = mark.at(std::string("elbow") + side);
    r.arm += 0.5 * ((elbow - shoulder).norm() + (mark.at(std::string("wrist") + side) - elbow).norm());
  }
  for (double y = r.inside_leg + 0.004 * r.height; y < 0.56 * r.height; y += 0.003 * r.height)
    r.fullest_hip = std::max(r.fullest_hip, trunk(mesh, {0, y, 0}, up));
  const double reach = std::max(std::abs(mark.at("armpit_right").x()), 0.06 * r.height) + 0.05 * r.height;
  r.arms_free = true;
  for (const Cut& c : cut(mesh, mark.at("bust_right"), up))
    if (c.low_x < 0 && c.high_x > 0) r.arms_free = r.arms_free && c.high_x < reach && c.low_x > -reach;
  return r;
}

FieldProbe probe_field(const TriMesh& body, const DistanceField& field, std::size_t points, double band,
                       std::uint64_t seed, double exact_share) {
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Mesh>>>;
  const Mesh mesh = to_cgal(body);
  FieldProbe r;
  Tree tree(faces(mesh).first, faces(mesh).second, mesh);
  tree.accelerate_distance_queries();
  const CGAL::Side_of_triangle_mesh<Mesh, Kernel> side(mesh);
  std::mt19937_64 random(seed);
  const auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1.0p-53; };
  // Triangles by area, so that the points lie evenly about the surface.
  std::vector<double> area{0};
  for (const Triangle& t : body.triangles)
    area.push_back(area.back() +
                   (body.vertices[t[1]] - body.vertices[t[0]]).cross(body.vertices[t[2]] - body.vertices[t[0]]).norm());
  std::size_t good = 0;
  std::vector<Vec3> places;
  while (places.size() < points) {
    const auto i = static_cast<std::size_t>(std::upper_bound(area.begin(), area.end(), uniform() * area.back()) -
                                            area.begin() - 1);
    const Triangle& t = body.triangles[std::min(i, body.triangles.size() - 1)];
    double a = uniform(), b = uniform();
    if (a + b > 1) a = 1 - a, b = 1 - b;
    const Vec3 e1 = body.vertices[t[1]] - body.vertices[t[0]], e2 = body.vertices[t[2]] - body.vertices[t[0]];
    places.push_back(body.vertices[t[0]] + a * e1 + b * e2 + (2 * uniform() - 1) * band * e1.cross(e2).normalized());
  }
  for (const Vec3& p : places) {
    const bool inside = side(point(p)) == CGAL::ON_BOUNDED_SIDE;
    const double exact = std::sqrt(tree.squared_distance(point(p))) * (inside ? -1 : 1), got = field.distance(p);
    const double off = std::abs(got - exact);
    r.worst = std::max(r.worst, off);
    good += off <= 5e-4 ? 1 : 0;
    // How deep a wrong sign lies tells whether it is more than rounding.
    if ((got < 0) == inside || std::abs(exact) < 1e-9) continue;
    ++r.wrong_signs;
    if (std::abs(exact) > 5e-4) ++r.wrong_beyond_half_mm;
    r.deepest_wrong_sign = std::max(r.deepest_wrong_sign, std::abs(exact));
  }
  r.points = places.size();
  r.within_half_mm = static_cast<double>(good) / static_cast<double>(places.size());

  double sum = 0;
  const auto lookups = [&] {
    const auto begin = std::clock();
    Vec3 gradient;
    constexpr int rounds = 100;
    for (int i = 0; i < rounds; ++i)
      for (const Vec3& p : places) sum += field.distance(p, gradient) + gradient.x();
    return std::isfinite(sum) ? rounds * static_cast<double>(places.size()) / seconds_since(begin) : 0.0;
  };
  r.random_lookups_per_second = lookups();
  // A cloth's nodes are asked for one after the other along the surface, not all over the body.
  std::stable_sort(places.begin(), places.end(), [](const Vec3& a, const Vec3& b) {
    const auto patch = [](const Vec3& p) {
      return std::array<int, 3>{static_cast<int>(std::floor(p.z() * 25)), static_cast<int>(std::floor(p.y() * 25)),
                                static_cast<int>(std::floor(p.x() * 25))};
    };
    return patch(a) < patch(b);
  });
  r.lookups_per_second = lookups();

  auto start = std::clock();
  const int step = std::max(1, static_cast<int>(std::lround(1 / exact_share)));
  int slabs = 0;
  for (int z = step / 2; z < field.size[2]; z += step, ++slabs)
    for (int y = 0; y < field.size[1]; ++y)
      for (int x = 0; x < field.size[0]; ++x) {
        const Point p = point(field.origin + field.spacing * Vec3(x, y, z));
        const bool inside = side(p) == CGAL::ON_BOUNDED_SIDE;
        sum += std::sqrt(tree.squared_distance(p)) * (inside ? -1 : 1);
        const float kept =
            field.values[static_cast<std::size_t>(x) +
                         static_cast<std::size_t>(field.size[0]) *
                             (static_cast<std::size_t>(y) + static_cast<std::size_t>(field.size[1]) * z)];
        if ((kept < 0) != inside) ++r.wrong_voxel_signs;
      }
  r.exact_seconds = seconds_since(start) * field.size[2] / std::max(1, slabs) + (std::isfinite(sum) ? 0 : 1);
  return r;
}

}  // namespace vitrine::bench
