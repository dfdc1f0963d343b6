// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <cstdint>
#include <random>

// Own mappings from bits to numbers: the distributions of <random> differ between standard libraries, mt19937 does not.
namespace vitrine::support {

/// A bump: 1 at 0, next to nothing beyond 2.
inline double bell(double x) {
  return std::exp(-x * x);
}

class Dice {
 public:
  explicit Dice(std::uint32_t seed) : engine_(seed) {}
  double unit() { return static_cast<double>(engine_()) / 4294967296.0; }
  double range(double low, double high) { return low + (high - low) * unit(); }
  int pick(int count) { return static_cast<int>(unit() * count); }

 private:
  std::mt19937 engine_;
};

inline std::uint32_t hash(std::int32_t x, std::int32_t y, std::uint32_t seed) {
  std::uint32_t h = seed * 0x9E3779B9u ^ static_cast<std::uint32_t>(x) * 0x85EBCA6Bu;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h ^= static_cast<std::uint32_t>(y) * 0xC2B2AE35u;
  h = (h ^ (h >> 13)) * 0x297A2D39u;
  return h ^ (h >> 16);
}

inline double hash_unit(std::int32_t x, std::int32_t y, std::uint32_t seed) {
  return hash(x, y, seed) / 4294967296.0;
}

/// Smooth noise in [-1, 1] with features of about one unit.
inline double noise(double x, double y, std::uint32_t seed) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto ix = static_cast<std::int32_t>(fx), iy = static_cast<std::int32_t>(fy);
  const double tx = x - fx, ty = y - fy;
  const double sx = tx * tx * tx * (tx * (tx * 6 - 15) + 10), sy = ty * ty * ty * (ty * (ty * 6 - 15) + 10);
  const double a = hash_unit(ix, iy, seed), b = hash_unit(ix + 1, iy, seed);
  const double c = hash_unit(ix, iy + 1, seed), d = hash_unit(ix + 1, iy + 1, seed);
  return 2 * (a + sx * (b - a) + sy * (c - a + sx * (a - b - c + d))) - 1;
}

/// Sum of octaves, each half as large and half as wide as the one before.
inline double fractal_noise(double x, double y, int octaves, std::uint32_t seed) {
  double sum = 0, size = 1;
  for (int i = 0; i < octaves; ++i, size *= 0.5, x *= 2.03, y *= 2.03) sum += size * noise(x, y, seed + 101u * i);
  return sum;
}

inline double smooth_step(double from, double to, double x) {
  const double t = x <= from ? 0 : x >= to ? 1 : (x - from) / (to - from);
  return t * t * (3 - 2 * t);
}

}  // namespace vitrine::support
