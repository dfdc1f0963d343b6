// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include "vitrine/rays.hpp"
#include "vitrine/sampling.hpp"

namespace vitrine {

double Sky::open(const Vec3& point, const Vec3& normal, const Sequence& sequence) const {
  int open = 0;
  // Their reach is short, so rays of one point pass the same few boxes wherever they go: four at a time.
  for (int k = 0; k < rays_; k += 4) {
    std::array<Vec3, 4> directions;
    std::array<double, 4> reach;
    const int count = std::min(4, rays_ - k);
    for (int i = 0; i < 4; ++i) {
      directions[i] = i < count ? cosine_direction(normal, sequence.point(k + i)) : normal;
      reach[i] = i < count ? reach_ * (0.06 + 0.94 * sequence.third(k + i)) : -1.0;
    }
    const auto blocked = tracer_.blocked(point, directions, reach);
    for (int i = 0; i < count; ++i) open += !blocked[i];
  }
  return static_cast<double>(open) / rays_;
}

}  // namespace vitrine
