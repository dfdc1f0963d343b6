// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "vitrine/model/geometry.hpp"

namespace vitrine::body {

/// One station of a loft: a closed curve of two half super-ellipses, |x/a|^n + |z/b|^n = 1, sharing the half width `a`.
struct Section {
  double s = 0;                    ///< [m] position along the axis
  double x = 0, z = 0;             ///< [m] centre across the axis
  double a = 0;                    ///< [m] half width
  double front = 0, back = 0;      ///< [m] depth towards +z and -z
  double n_front = 2, n_back = 2;  ///< [-] exponents
};

/// Tape around a section: the perimeter of the (convex) super-ellipse [m].
double section_girth(double a, double front, double back, double n_front, double n_back);

/// A limb or the trunk: sections along a straight axis, every parameter interpolated by a monotone cubic and then
/// smoothed, so that no station shows as a ring.
class Loft {
 public:
  Loft() = default;
  /// `along`, `across`, `forward` are orthonormal; `smoothing` [m] is the half width of the smoothing window;
  /// `rounding` [m] softens the two ends.
  Loft(const std::vector<Section>& sections, const Vec3& origin, const Vec3& along, const Vec3& across,
       const Vec3& forward, double smoothing, double rounding);

  /// First-order signed distance [m], negative inside: (g - 1) / |grad g| of the section's gauge function g.
  double distance(const Vec3& p) const;
  Section at(double s) const;
  const Vec3& low() const { return low_; }
  const Vec3& high() const { return high_; }

 private:
  bool elliptic_ = false;  ///< all exponents are 2: no powers needed
  double step_ = 0.004, start_ = 0, end_ = 0, rounding_ = 0;
  Vec3 origin_ = Vec3::Zero(), along_ = Vec3::UnitY(), across_ = Vec3::UnitX(), forward_ = Vec3::UnitZ();
  Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();
  std::vector<Section> table_;
};

/// Monotone cubic (Fritsch-Carlson) through (x_i, y_i), x ascending; constant beyond the ends.
double monotone_cubic(const std::vector<double>& x, const std::vector<double>& y, double at);

/// Smooth minimum with continuous second derivative; differs from min() only where |a - b| < k, by at most k / 6.
inline double smooth_min(double a, double b, double k) {
  const double d = a < b ? b - a : a - b;
  const double m = a < b ? a : b;
  if (d >= k) return m;
  const double h = 1 - d / k;
  return m - h * h * h * k / 6;
}
inline double smooth_max(double a, double b, double k) {
  return -smooth_min(-a, -b, k);
}

}  // namespace vitrine::body
