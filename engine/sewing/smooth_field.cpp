// SPDX-License-Identifier: GPL-3.0-or-later
#include "smooth_field.hpp"

#include <cmath>

#include "lanes.hpp"

namespace vitrine::sewing {

namespace {

/// What the weights of the 27 voxels come to; the fourth number of a row belongs to no voxel and weighs nothing.
struct Sampled {
  double distance, slope[3];
};

VITRINE_WIDE Sampled sample(const float* corner, std::size_t sy, std::size_t sz, const double* weight,
                            const double* slope) {
  Four value = {}, by_y = {}, by_z = {};
  for (int z = 0; z < 3; ++z) {
    Four plane = {}, plane_y = {};
    for (int y = 0; y < 3; ++y) {
      const float* v = corner + z * sz + y * sy;
      const Four row = {v[0], v[1], v[2], 0};
      plane += weight[4 + y] * row;
      plane_y += slope[4 + y] * row;
    }
    value += weight[8 + z] * plane;
    by_y += weight[8 + z] * plane_y;
    by_z += slope[8 + z] * plane;
  }
  const Four wx = load(weight);
  return {sum(wx * value), {sum(load(slope) * value), sum(wx * by_y), sum(wx * by_z)}};
}

}  // namespace

double smooth_distance(const DistanceField& field, const Vec3& p, Vec3& gradient) {
  int cell[3];
  double weight[12] = {}, slope[12] = {};  // four per axis, three used
  for (int a = 0; a < 3; ++a) {
    const double t = (p[a] - field.origin[a]) / field.spacing;
    // Also false for NaN and for grids of fewer than three samples.
    if (!(t >= 0.5 && t < field.size[a] - 1.5)) return field.distance(p, gradient);
    cell[a] = static_cast<int>(t + 0.5);
    const double u = t - cell[a];  // -0.5 .. 0.5 from the nearest sample
    double *w = weight + 4 * a, *s = slope + 4 * a;
    w[0] = 0.5 * (0.5 - u) * (0.5 - u);
    w[1] = 0.75 - u * u;
    w[2] = 0.5 * (0.5 + u) * (0.5 + u);
    s[0] = u - 0.5;
    s[1] = -2 * u;
    s[2] = u + 0.5;
  }
  const std::size_t sy = static_cast<std::size_t>(field.size[0]), sz = sy * static_cast<std::size_t>(field.size[1]);
  const float* corner = field.values.data() + (cell[2] - 1) * sz + (cell[1] - 1) * sy + (cell[0] - 1);
  const Sampled s = sample(corner, sy, sz, weight, slope);
  gradient = Vec3(s.slope[0], s.slope[1], s.slope[2]) / field.spacing;
  return s.distance;
}

}  // namespace vitrine::sewing
