// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "vitrine/model/body.hpp"

namespace vitrine {

double DistanceField::distance(const Vec3& p, Vec3& gradient) const {
  // Outside the grid the nearest sample's value plus the way to the grid is a lower-quality but safe estimate.
  int cell[3];
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
  }
  return d;
}

double DistanceField::distance(const Vec3& p) const {
  Vec3 ignored;
  return distance(p, ignored);
}

}  // namespace vitrine
