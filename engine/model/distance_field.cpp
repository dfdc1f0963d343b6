// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "vitrine/model/body.hpp"

namespace vitrine {

namespace {

// Ericson, Real-Time Collision Detection, 5.1.5.
template <typename V>
V nearest_on(const V& p, const V& a, const V& b, const V& c) {
  const V ab = b - a, ac = c - a, ap = p - a;
  const auto d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const V bp = p - b;
  const auto d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const auto vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const V cp = p - c;
  const auto d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const auto vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const auto va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b);
  const auto denominator = va + vb + vc;
  if (!(denominator > 0)) return a;
  return a + vb / denominator * ab + vc / denominator * ac;
}

}  // namespace

Vec3 nearest_point(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  return nearest_on<Vec3>(p, a, b, c);
}

double SurfacePatches::distance(const Vec3& p, std::int32_t cell) const {
  // Floats about a triangle's own corner: there 1e-7 is less than a nanometre.
  constexpr float same = 1e-8F;
  float least = std::numeric_limits<float>::max(), height = 0;
  const std::uint32_t* list = &first[static_cast<std::size_t>(cell)];
  for (std::uint32_t i = list[0]; i < list[1]; ++i) {
    const Facet& f = facets[facet[i]];
    const Eigen::Vector3f q = (p - f.a).cast<float>();
    const float h = f.normal.dot(q);
    if (std::abs(h) > least + same) continue;
    const float d = (q - nearest_on<Eigen::Vector3f>(q, Eigen::Vector3f::Zero(), f.ab, f.ac)).norm();
    // On an edge or corner several triangles are equally near: the one seen least from the side tells the sign.
    if (d < least - same || (d < least + same && std::abs(h) > std::abs(height))) height = h;
    least = std::min(least, d);
  }
  return height < 0 ? -least : least;
}

double DistanceField::near_surface(const Vec3& p, const std::array<int, 3>& at, double d) const {
  const std::int32_t cell = patches.cell(at);
  if (cell < 0) return d;
  // Exact where interpolation may err on the sign, and from there gradually what it was.
  const double reach = patches.reach_of(cell), beyond = std::abs(d) - reach;
  if (beyond >= (SurfacePatches::fade - 1) * reach) return d;
  const double exact = patches.distance(p, cell);
  if (beyond <= 0) return exact;
  const double t = beyond / ((SurfacePatches::fade - 1) * reach);
  return exact + t * t * (3 - 2 * t) * (d - exact);
}

double DistanceField::distance(const Vec3& p, Vec3& gradient) const {
  // Outside the grid the nearest sample's value plus the way to the grid is a lower-quality but safe estimate.
  std::array<int, 3> cell;
  double frac[3];
  Vec3 beyond = Vec3::Zero();
  const double per_metre = 1 / spacing;
  for (int a = 0; a < 3; ++a) {
    const double hi = static_cast<double>(size[a] - 1);
    double t = (p[a] - origin[a]) * per_metre;
    if (!(t >= 0)) {
      beyond[a] = t * spacing;
      t = 0;
    } else if (t > hi) {
      beyond[a] = (t - hi) * spacing;
      t = hi;
    }
    cell[a] = std::min(static_cast<int>(t), size[a] - 2);
    frac[a] = t - cell[a];
  }
  const std::size_t sx = 1, sy = static_cast<std::size_t>(size[0]), sz = sy * static_cast<std::size_t>(size[1]);
  const float* v = values.data() + cell[0] * sx + cell[1] * sy + cell[2] * sz;
  const double x = frac[0], y = frac[1], z = frac[2];
  const double c000 = v[0], c100 = v[sx], c010 = v[sy], c110 = v[sx + sy];
  const double c001 = v[sz], c101 = v[sx + sz], c011 = v[sy + sz], c111 = v[sx + sy + sz];
  const double c00 = c000 + x * (c100 - c000), c10 = c010 + x * (c110 - c010);
  const double c01 = c001 + x * (c101 - c001), c11 = c011 + x * (c111 - c011);
  const double c0 = c00 + y * (c10 - c00), c1 = c01 + y * (c11 - c01);
  gradient.z() = (c1 - c0) * per_metre;
  gradient.y() = ((1 - z) * (c10 - c00) + z * (c11 - c01)) * per_metre;
  gradient.x() =
      ((1 - z) * ((1 - y) * (c100 - c000) + y * (c110 - c010)) + z * ((1 - y) * (c101 - c001) + y * (c111 - c011))) *
      per_metre;
  double d = c0 + z * (c1 - c0);
  const double out2 = beyond.squaredNorm();
  if (out2 > 0) {
    const double out = std::sqrt(out2);
    d += out;
    gradient = beyond / out;
    return d;
  }
  if (std::abs(d) < 0.87 * spacing && !patches.brick.empty()) return near_surface(p, cell, d);
  return d;
}

double DistanceField::distance(const Vec3& p) const {
  Vec3 ignored;
  return distance(p, ignored);
}

}  // namespace vitrine
