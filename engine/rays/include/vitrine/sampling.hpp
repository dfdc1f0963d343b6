// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>

#include "vitrine/model/geometry.hpp"

namespace vitrine {

/// Points that fill the unit square evenly (Roberts' R2 sequence), turned by an offset of the pixel's own. The offset
/// is a hash of the pixel, never a random device: the same picture every time.
class Sequence {
 public:
  Sequence(std::uint32_t x, std::uint32_t y, std::uint32_t stream) {
    const std::uint32_t a = mix(x * 0x9e3779b9u ^ mix(y * 0x85ebca6bu ^ mix(stream)));
    shift_ = Vec2(a * 0x1p-32, mix(a ^ 0x68bc21ebu) * 0x1p-32);
    third_ = mix(a ^ 0x02e5be93u) * 0x1p-32;
  }
  Vec2 point(int i) const {
    return {fraction(shift_.x() + i * 0.7548776662466927), fraction(shift_.y() + i * 0.5698402909980532)};
  }
  /// A third, independent number of the i-th point.
  double third(int i) const { return fraction(third_ + i * 0.6180339887498949); }

 private:
  static std::uint32_t mix(std::uint32_t h) {
    h ^= h >> 16;
    h *= 0x7feb352du;
    h ^= h >> 15;
    h *= 0x846ca68bu;
    return h ^ (h >> 16);
  }
  static double fraction(double v) { return v - std::floor(v); }
  Vec2 shift_;
  double third_ = 0;
};

/// Two directions that make a right-handed frame with unit n (Duff et al. 2017).
inline void tangents(const Vec3& n, Vec3& a, Vec3& b) {
  const double sign = std::copysign(1.0, n.z()), c = -1.0 / (sign + n.z()), d = n.x() * n.y() * c;
  a = Vec3(1.0 + sign * n.x() * n.x() * c, sign * d, -sign * n.x());
  b = Vec3(d, sign + n.y() * n.y() * c, -n.y());
}

/// Direction about unit n with the density of the cosine.
inline Vec3 cosine_direction(const Vec3& n, const Vec2& s) {
  Vec3 a, b;
  tangents(n, a, b);
  const double r = std::sqrt(s.x()), phi = 2 * std::numbers::pi * s.y();
  return r * std::cos(phi) * a + r * std::sin(phi) * b + std::sqrt(std::max(0.0, 1.0 - s.x())) * n;
}

/// Direction within a disc of radius `spread` (tangent of the half angle) about unit n.
inline Vec3 cone_direction(const Vec3& n, double spread, const Vec2& s) {
  Vec3 a, b;
  tangents(n, a, b);
  const double r = spread * std::sqrt(s.x()), phi = 2 * std::numbers::pi * s.y();
  return (n + r * std::cos(phi) * a + r * std::sin(phi) * b).normalized();
}

}  // namespace vitrine
