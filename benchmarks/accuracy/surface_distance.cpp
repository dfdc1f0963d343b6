// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_distance.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace vitrine::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

constexpr double area_of_a_sample = 4e-5;  // [m^2]: about 6 mm apart

struct Sample {
  double distance, area;
};

void add_distances(const Surface& from, const Surface& to, double share, std::vector<Sample>& out) {
  const auto point = [](const Vec3& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
  Triangles triangles;
  for (const Triangle& t : to.triangles)
    triangles.emplace_back(point(to.points[t[0]]), point(to.points[t[1]]), point(to.points[t[2]]));
  Tree tree(triangles.begin(), triangles.end());
  tree.accelerate_distance_queries();
  double total = 0, owed = 0;
  const std::size_t first = out.size();
  for (const Triangle& t : from.triangles) {
    const Vec3 a = from.points[t[0]], u = from.points[t[1]] - a, w = from.points[t[2]] - a;
    const double area = 0.5 * u.cross(w).norm();
    owed += area;
    // A triangle that is owed less than a sample leaves it to the next one; a large one is cut into n x n.
    if (owed < area_of_a_sample) continue;
    const int n = std::max(1, static_cast<int>(std::sqrt(area / area_of_a_sample)));
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j)
        for (int half = 0; half < 2; ++half) {
          if (half == 1 && i + j + 1 >= n) continue;
          const double s = (i + (half ? 2.0 : 1.0) / 3) / n, r = (j + (half ? 2.0 : 1.0) / 3) / n;
          out.push_back({std::sqrt(tree.squared_distance(point(a + s * u + r * w))), owed / (n * n)});
        }
    total += owed;
    owed = 0;
  }
  for (std::size_t i = first; i < out.size(); ++i) out[i].area *= share / total;
}

}  // namespace

SurfaceDistance surface_distance(const Surface& a, const Surface& b) {
  std::vector<Sample> samples;
  add_distances(a, b, 0.5, samples);
  add_distances(b, a, 0.5, samples);
  std::sort(samples.begin(), samples.end(), [](const Sample& s, const Sample& t) { return s.distance < t.distance; });
  SurfaceDistance out;
  double sum = 0;
  for (const Sample& s : samples) {
    out.mean += s.area * s.distance;
    if (sum < 0.95) out.p95 = s.distance;
    sum += s.area;
  }
  out.most = samples.empty() ? 0 : samples.back().distance;
  return out;
}

}  // namespace vitrine::bench
