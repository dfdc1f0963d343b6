// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cloth.hpp"
#include "contact.hpp"
#include "layers.hpp"

namespace vitrine::sewing {

/// Node `n` of packed numbers.
inline Vec3 at(const Packed& v, int n) {
  return {v[4 * n], v[4 * n + 1], v[4 * n + 2]};
}

/// The part of a node's force that friction of coefficient `mu` cannot hold. `push` is the body's push on the node [N].
Vec3 outside_cone(const Vec3& force, const Vec3& push, double mu);

/// sum |net force| / scale over the free nodes, where friction takes up to mu N of the tangential force at nodes the
/// body pushes. Looks at every contact sample afresh.
double residual_of(const Cloth& cloth, Contact* contact, double friction, Layers* layers = nullptr);

}  // namespace vitrine::sewing
