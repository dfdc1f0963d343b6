// SPDX-License-Identifier: GPL-3.0-or-later
#include "densities.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

// AVX2 without fused multiply-adds: twice as many numbers at a time, the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define VITRINE_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define VITRINE_WIDE
#endif

namespace vitrine {
namespace {

/// e^x to about 0.1 %, for x <= 80; next to nothing below -80.
inline float quick_exp(float x) {
  const float t = std::max(x, -80.0f) * 1.44269504f + 127.0f;
  const int whole = static_cast<int>(t);
  const float rest = t - static_cast<float>(whole);
  const float mantissa = 1.0f + rest * (0.69606564f + rest * (0.22449433f + rest * 0.07944023f));
  return std::bit_cast<float>(whole << 23) * mantissa;
}

VITRINE_WIDE void density_row(const float* __restrict l, const float* __restrict a, const float* __restrict b, int n,
                              std::array<float, 6> u, std::array<float, 3> m, float level, float* __restrict sum,
                              float* __restrict largest) {
  for (int i = 0; i < n; ++i) {
    const float d0 = l[i] - m[0], d1 = a[i] - m[1], d2 = b[i] - m[2];
    const float e0 = u[0] * d0 + u[1] * d1 + u[2] * d2, e1 = u[3] * d1 + u[4] * d2, e2 = u[5] * d2;
    const float value = level - 0.5f * (e0 * e0 + e1 * e1 + e2 * e2);
    sum[i] += quick_exp(value);
    largest[i] = largest[i] > value ? largest[i] : value;
  }
}

VITRINE_WIDE void shade_row(const float* __restrict l, const float* __restrict a, const float* __restrict b, int n,
                            std::array<float, 6> u, std::array<float, 3> m, std::array<float, 3> towards, float level,
                            float darkest, float depth_cost, float* __restrict sum, float* __restrict largest) {
  const float brightest = 0.97f;
  for (int i = 0; i < n; ++i) {
    const float wish = towards[0] * l[i] + towards[1] * a[i] + towards[2] * b[i];
    const float t = wish < darkest ? darkest : wish > brightest ? brightest : wish;
    const float d0 = l[i] - t * m[0], d1 = a[i] - t * m[1], d2 = b[i] - t * m[2];
    const float e0 = u[0] * d0 + u[1] * d1 + u[2] * d2, e1 = u[3] * d1 + u[4] * d2, e2 = u[5] * d2;
    const float value = level - depth_cost * (1 - t) - 0.5f * (e0 * e0 + e1 * e1 + e2 * e2);
    sum[i] += quick_exp(value);
    largest[i] = largest[i] > value ? largest[i] : value;
  }
}

VITRINE_WIDE void add_scaled_difference(const float* __restrict x, int n, float mean, float factor,
                                        float* __restrict out) {
  for (int i = 0; i < n; ++i) out[i] += factor * (x[i] - mean);
}

VITRINE_WIDE void take_half_square(const float* __restrict x, int n, float* __restrict out) {
  for (int i = 0; i < n; ++i) out[i] -= 0.5f * x[i] * x[i];
}

VITRINE_WIDE void keep_larger(const float* __restrict x, int n, float* __restrict out) {
  for (int i = 0; i < n; ++i) out[i] = out[i] > x[i] ? out[i] : x[i];
}

VITRINE_WIDE void exp_of_difference(float* __restrict x, const float* __restrict largest, int n,
                                    float* __restrict sum) {
  for (int i = 0; i < n; ++i) {
    x[i] = quick_exp(x[i] - largest[i]);
    sum[i] += x[i];
  }
}

VITRINE_WIDE void divide(float* __restrict x, const float* __restrict by, int n) {
  for (int i = 0; i < n; ++i) x[i] /= by[i];
}

std::array<float, 6> upper(const Eigen::Matrix3f& u) {
  return {u(0, 0), u(0, 1), u(0, 2), u(1, 1), u(1, 2), u(2, 2)};
}

std::array<float, 3> numbers(const Eigen::Vector3f& v) {
  return {v[0], v[1], v[2]};
}

}  // namespace

void LogSum::clear(std::size_t n) {
  sum.assign(n, 0.0f);
  largest.assign(n, -1e30f);
}

float LogSum::at(std::size_t i) const {
  return sum[i] > 1e-25f ? std::log(sum[i]) : largest[i];
}

void add_density(const ColourRow& row, const Eigen::Matrix3f& u, const Eigen::Vector3f& mean, float level,
                 LogSum& out) {
  density_row(row.l, row.a, row.b, row.n, upper(u), numbers(mean), level, out.sum.data(), out.largest.data());
}

void add_shade_density(const ColourRow& row, const Eigen::Matrix3f& u, const Eigen::Vector3f& lit,
                       const Eigen::Vector3f& towards, float level, float darkest, float depth_cost, LogSum& out) {
  shade_row(row.l, row.a, row.b, row.n, upper(u), numbers(lit), numbers(towards), level, darkest, depth_cost,
            out.sum.data(), out.largest.data());
}

void log_densities(std::span<const float> x, std::span<const float> u, std::span<const float> mean, float level,
                   std::span<float> out) {
  const std::size_t d = mean.size(), n = out.size();
  const int count = static_cast<int>(n);
  std::fill(out.begin(), out.end(), level);
  std::vector<float> row(n);
  for (std::size_t j = 0; j < d; ++j) {
    std::fill(row.begin(), row.end(), 0.0f);
    for (std::size_t k = j; k < d; ++k)
      add_scaled_difference(x.data() + k * n, count, mean[k], u[j * d + k], row.data());
    take_half_square(row.data(), count, out.data());
  }
}

void to_shares(std::span<float> logs, int parts) {
  const std::size_t n = logs.size() / static_cast<std::size_t>(parts);
  const int count = static_cast<int>(n);
  std::vector<float> largest(logs.begin(), logs.begin() + static_cast<std::ptrdiff_t>(n)), sum(n, 0.0f);
  for (std::size_t k = 1; k < static_cast<std::size_t>(parts); ++k)
    keep_larger(logs.data() + k * n, count, largest.data());
  for (std::size_t k = 0; k < static_cast<std::size_t>(parts); ++k)
    exp_of_difference(logs.data() + k * n, largest.data(), count, sum.data());
  for (std::size_t k = 0; k < static_cast<std::size_t>(parts); ++k) divide(logs.data() + k * n, sum.data(), count);
}

}  // namespace vitrine
