// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/rays.hpp"
#include "vitrine/sampling.hpp"

namespace vitrine {

double Sky::open(const Vec3& point, const Vec3& normal, const Sequence& sequence) const {
  const int open = tracer_.count_free(point, rays_, [&](int k) {
    return std::pair(cosine_direction(normal, sequence.point(k)), reach_ * (0.06 + 0.94 * sequence.third(k)));
  });
  return static_cast<double>(open) / rays_;
}

}  // namespace vitrine
