// SPDX-License-Identifier: GPL-3.0-or-later
#include "smooth_field.hpp"

#include <cmath>

namespace vitrine::sewing {

double smooth_distance(const DistanceField& field, const Vec3& p, Vec3& gradient) {
  int cell[3];
  double weight[3][3], slope[3][3];
  for (int a = 0; a < 3; ++a) {
    const double t = (p[a] - field.origin[a]) / field.spacing;
    // Also false for NaN and for grids of fewer than three samples.
    if (!(t >= 0.5 && t < field.size[a] - 1.5)) return field.distance(p, gradient);
    cell[a] = static_cast<int>(t + 0.5);
    const double u = t - cell[a];  // -0.5 .. 0.5 from the nearest sample
    weight[a][0] = 0.5 * (0.5 - u) * (0.5 - u);
    weight[a][1] = 0.75 - u * u;
    weight[a][2] = 0.5 * (0.5 + u) * (0.5 + u);
    slope[a][0] = u - 0.5;
    slope[a][1] = -2 * u;
    slope[a][2] = u + 0.5;
  }
  const std::size_t sy = static_cast<std::size_t>(field.size[0]), sz = sy * static_cast<std::size_t>(field.size[1]);
  const float* corner = field.values.data() + (cell[2] - 1) * sz + (cell[1] - 1) * sy + (cell[0] - 1);
  double d = 0, gx = 0, gy = 0, gz = 0;
  for (int z = 0; z < 3; ++z) {
    double plane = 0, plane_x = 0, plane_y = 0;
    for (int y = 0; y < 3; ++y) {
      const float* v = corner + z * sz + y * sy;
      const double a = v[0], b = v[1], c = v[2];
      const double row = weight[0][0] * a + weight[0][1] * b + weight[0][2] * c;
      plane += weight[1][y] * row;
      plane_y += slope[1][y] * row;
      plane_x += weight[1][y] * (slope[0][0] * a + slope[0][1] * b + slope[0][2] * c);
    }
    d += weight[2][z] * plane;
    gx += weight[2][z] * plane_x;
    gy += weight[2][z] * plane_y;
    gz += slope[2][z] * plane;
  }
  gradient = Vec3(gx, gy, gz) / field.spacing;
  return d;
}

}  // namespace vitrine::sewing
