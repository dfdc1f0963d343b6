// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <cstring>

// AVX2 without fused multiply-adds where the machine has it: the same operations in the same order, so the same bytes.
// A test builds with VITRINE_PLAIN, without it, and compares.
#if !defined(VITRINE_PLAIN) && defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define VITRINE_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define VITRINE_WIDE
#endif
// The helpers below are always inlined: how a vector would be passed to them does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"
#define VITRINE_INLINE inline __attribute__((always_inline))

namespace vitrine::sewing {

/// Four numbers that are computed at once. Nodes lie in memory as x, y, z and an unused 0: one load each.
typedef double Four __attribute__((vector_size(32)));

VITRINE_INLINE Four load(const double* p) {
  Four v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
VITRINE_INLINE void store(double* p, const Four& v) {
  std::memcpy(p, &v, sizeof v);
}
VITRINE_INLINE Four root(const Four& v) {
  Four r;
  for (int l = 0; l < 4; ++l) r[l] = std::sqrt(v[l]);
  return r;
}
/// Squared lengths of four vectors.
VITRINE_INLINE Four squares(const Four& a, const Four& b, const Four& c, const Four& d) {
  const Four ab_xz = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab_yw = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Four cd_xz = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd_yw = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  const Four x = __builtin_shufflevector(ab_xz, cd_xz, 0, 1, 4, 5),
             z = __builtin_shufflevector(ab_xz, cd_xz, 2, 3, 6, 7);
  const Four y = __builtin_shufflevector(ab_yw, cd_yw, 0, 1, 4, 5);
  return x * x + y * y + z * z;
}
VITRINE_INLINE double sum(const Four& v) {
  return (v[0] + v[1]) + (v[2] + v[3]);
}

}  // namespace vitrine::sewing
