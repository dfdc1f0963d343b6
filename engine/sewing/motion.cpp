// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion.hpp"

#include <algorithm>

#include "lanes.hpp"

namespace vitrine::sewing {

VITRINE_WIDE Sums sums_of(const double* f, const double* v, const double* mass, std::size_t nodes) {
  Four force = {}, power = {}, vv = {};
  for (std::size_t n = 0; n < nodes; n += 4) {
    const Four f0 = load(f + 4 * n), f1 = load(f + 4 * n + 4), f2 = load(f + 4 * n + 8), f3 = load(f + 4 * n + 12);
    const Four v0 = load(v + 4 * n), v1 = load(v + 4 * n + 4), v2 = load(v + 4 * n + 8), v3 = load(v + 4 * n + 12);
    force += root(squares(f0, f1, f2, f3));
    power += f0 * v0 + f1 * v1 + f2 * v2 + f3 * v3;
    vv += load(mass + n) * squares(v0, v1, v2, v3);
  }
  return {sum(force), sum(power), sum(vv)};
}

VITRINE_WIDE void scale_by_node(const double* f, const double* per_mass, std::size_t nodes, double* out) {
  for (std::size_t n = 0; n < nodes; ++n) store(out + 4 * n, per_mass[n] * load(f + 4 * n));
}

VITRINE_WIDE double squares_by_mass(const double* a, const double* mass, std::size_t nodes) {
  Four aa = {};
  for (std::size_t n = 0; n < nodes; n += 4)
    aa += load(mass + n) * squares(load(a + 4 * n), load(a + 4 * n + 4), load(a + 4 * n + 8), load(a + 4 * n + 12));
  return sum(aa);
}

VITRINE_WIDE void steer(double keep, double push, const double* a, std::size_t count, double* v) {
  for (std::size_t i = 0; i < count; i += 4) store(v + i, keep * load(v + i) + push * load(a + i));
}

VITRINE_WIDE double move(double dt, const double* v, std::size_t nodes, double* x, double* path) {
  Four most = {};
  for (std::size_t n = 0; n < nodes; n += 4) {
    const Four s0 = dt * load(v + 4 * n), s1 = dt * load(v + 4 * n + 4), s2 = dt * load(v + 4 * n + 8),
               s3 = dt * load(v + 4 * n + 12);
    const Four length = root(squares(s0, s1, s2, s3));
    most = length > most ? length : most;
    store(path + n, load(path + n) + length);
    store(x + 4 * n, load(x + 4 * n) + s0);
    store(x + 4 * n + 4, load(x + 4 * n + 4) + s1);
    store(x + 4 * n + 8, load(x + 4 * n + 8) + s2);
    store(x + 4 * n + 12, load(x + 4 * n + 12) + s3);
  }
  return std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
}

VITRINE_WIDE void add_neighbours(const int* a, const int* b, std::size_t edges, const double* v, double* sum) {
  for (std::size_t e = 0; e < edges; ++e) {
    const int i = 4 * a[e], j = 4 * b[e];
    store(sum + i, load(sum + i) + load(v + j));
    store(sum + j, load(sum + j) + load(v + i));
  }
}

}  // namespace vitrine::sewing
