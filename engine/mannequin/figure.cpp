// SPDX-License-Identifier: GPL-3.0-or-later
#include "figure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hull.hpp"

namespace vitrine::body {

namespace {

constexpr double far_away = 1.0;  ///< [m] stands for "too far to matter": more than any blend radius

/// True when p is too far from the loft's box to touch any blend.
bool beyond(const Loft& loft, const Vec3& p, double margin) {
  for (int a = 0; a < 3; ++a)
    if (p[a] < loft.low()[a] - margin || p[a] > loft.high()[a] + margin) return true;
  return false;
}

Vec3 mirrored(const Vec3& p) {
  return {-p.x(), p.y(), p.z()};
}

}  // namespace

double Figure::blob(const Blob& s, const Vec3& p) {
  const Vec3 d = p - s.centre;
  const Vec3 r(s.x, d.y() > 0 ? s.up : s.down, s.z);
  const Vec3 q = d.cwiseQuotient(r);
  const double k0 = q.norm(), k1 = q.cwiseQuotient(r).norm();
  return k1 > 1e-9 ? k0 * (k0 - 1) / k1 : -r.minCoeff();
}

double Figure::cone(const Cone& c, const Vec3& p) {
  const Vec3 ab = c.b - c.a;
  const double t = std::clamp((p - c.a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (p - c.a - t * ab).norm() - (c.ra + t * (c.rb - c.ra));
}

/// The chest's distance, less what the breasts raise it by: hills that begin without an edge, where an ellipsoid would
/// sit on a shelf.
double Figure::raised(double d, const Vec3& near) const {
  const Hill& hill = bosom_;
  const double y = (near.y() - bust_height) / (near.y() > bust_height ? hill.up : hill.down);
  if (std::abs(y) >= 1) return d;
  double height = 0, steep = 0;
  for (const double x : {near.x(), -near.x()}) {
    const double across = (x - bust_apart) / (x > bust_apart ? hill.outside : hill.inside),
                 r2 = across * across + y * y;
    if (r2 >= 1) continue;
    height += (1 - r2) * (1 - r2) * (1 + 0.5 * r2);
    steep += 3 * std::sqrt(r2) * (1 - r2) * (1 + r2);
  }
  const double t = std::clamp((near.z() - hill.side) / (hill.front - hill.side), 0.0, 1.0);
  const double forward = breast * t * t * (3 - 2 * t);
  // A slope makes the way to the surface shorter than the way to the front.
  const double slope = forward * steep / std::min(hill.down, hill.outside);
  return (d - forward * height) / std::sqrt(1 + slope * slope);
}

double Figure::head(const Vec3& p) const {
  return smooth_min(blob(skull_, p), blob(face_, p), 0.045);
}

double Figure::leg_side(const Vec3& p) const {
  double d = beyond(leg_, p, 0.12) ? far_away : leg_.distance(p);
  if (!beyond(foot_, p, 0.06)) d = smooth_min(d, foot_.distance(p), 0.04);
  // The sole is the floor.
  return p.y() < 0.05 ? smooth_max(d, -p.y(), 0.008) : d;
}

double Figure::arm_side(const Vec3& p) const {
  double d = beyond(arm_, p, 0.12) ? far_away : arm_.distance(p);
  if (!beyond(hand_, p, 0.05)) d = smooth_min(d, smooth_min(hand_.distance(p), cone(thumb_, p), 0.024), 0.02);
  return d;
}

double Figure::distance(const Vec3& p) const {
  // The body is symmetric: `near` is the point on the right, `far` its mirror image, which only parts that reach the
  // middle have to look at.
  const Vec3 near(std::abs(p.x()), p.y(), p.z()), far = mirrored(near);
  double d = beyond(trunk_, near, 0.12) ? far_away : trunk_.distance(near);
  if (d < far_away && near.z() > bosom_.side && std::abs(p.y() - bust_height) < 0.25) d = raised(d, near);
  if (p.z() < 0.05 && std::abs(p.y() - hip_height) < 0.25)
    d = smooth_min(d, smooth_min(blob(seat_, near), blob(seat_, far), 0.05), 0.08);
  if (p.y() < fork_high_) {
    // Legs turn into the trunk rather than joining it: where outlines nearly coincide a smooth union would bulge.
    double legs = leg_side(near);
    if (near.x() < 0.06) legs = smooth_min(legs, leg_side(far), 0.012);
    const double t = std::clamp((p.y() - fork_low_) / (fork_high_ - fork_low_), 0.0, 1.0);
    d = legs + t * t * (3 - 2 * t) * (d - legs);
  }
  if (p.y() > bust_height - 0.05) {
    d = smooth_min(d, smooth_min(cone(girdle_, near), cone(girdle_, far), 0.03), 0.05);
    if (!beyond(neck_, near, 0.1)) d = smooth_min(d, neck_.distance(near), 0.045);
    d = smooth_min(d, head(near), 0.03);
  }
  if (const double arm = arm_side(near); arm < far_away) {
    // A wide blend makes the shoulder; further down the same blend would glue arm and trunk together.
    const double t = std::clamp((near - arm_root).dot(arm_axis) / arm_free_, 0.0, 1.0);
    const double fade = 1 - t * t * (3 - 2 * t);
    d = smooth_min(d, arm, 0.006 + (arm_blend_ - 0.006) * fade);
  }
  return d;
}

Vec3 Figure::exit(const Vec3& from, const Vec3& direction) const {
  double inside = 0, t = 0;
  for (int i = 0; i < 400 && t < 1.5; ++i) {
    const double d = distance(from + t * direction);
    if (d >= 0) break;
    inside = t;
    t += std::max(0.002, -0.7 * d);
  }
  double outside = t;
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (inside + outside);
    (distance(from + middle * direction) < 0 ? inside : outside) = middle;
  }
  return from + 0.5 * (inside + outside) * direction;
}

Vec3 Figure::entry(const Vec3& centre, const Vec3& direction, double reach) const {
  double outside = reach, t = reach;
  while (t > 0) {
    const double d = distance(centre + t * direction);
    if (d < 0) break;
    outside = t;
    t -= std::max(0.002, 0.7 * d);
  }
  double inside = std::max(t, 0.0);
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (inside + outside);
    (distance(centre + middle * direction) < 0 ? inside : outside) = middle;
  }
  return centre + 0.5 * (inside + outside) * direction;
}

double Figure::tape(const Vec3& centre, const Vec3& u, const Vec3& v, double reach) const {
  constexpr int rays = 64;
  std::vector<Vec2> points;
  points.reserve(rays);
  for (int i = 0; i < rays; ++i) {
    const double angle = 2 * std::numbers::pi * i / rays;
    const Vec3 way = std::cos(angle) * u + std::sin(angle) * v;
    const Vec3 d = (reach > 0 ? entry(centre, way, reach) : exit(centre, way)) - centre;
    points.emplace_back(d.dot(u), d.dot(v));
  }
  return hull_perimeter(points);
}

Vec3 Figure::leg_centre(double height) const {
  const Section s = leg_.at(height);
  return {s.x, height, s.z + 0.5 * (s.front - s.back)};
}

double Figure::detail(const Vec3& p) const {
  const Vec3 side(std::abs(p.x()), p.y(), p.z());
  const double past_wrist = (side - wrist).dot(arm_axis), above_neck = p.y() - neck_base.y();
  // Tight corners, too: crotch and armpits, where long edges would cut through the air.
  const double crotch = 1.6 - (p - Vec3(0, crotch_y_, 0.4 * p.z())).norm() / 0.05;
  const double armpit = 1.6 - (side - armpit_).norm() / 0.05;
  const double fine = std::max({armpit, (1.5 * ankle_height - p.y()) / 0.05, above_neck / 0.08});
  return 1 - std::max({0.42 * std::clamp(fine, 0.0, 1.0), 0.48 * std::clamp(past_wrist / 0.05, 0.0, 1.0),
                       0.60 * std::clamp(crotch, 0.0, 1.0)});
}

double Figure::crotch_height() const {
  double lowest = hip_height;
  for (double z = -0.06; z <= 0.0601; z += 0.01) {
    if (distance({0, hip_height, z}) >= 0) continue;
    lowest = std::min(lowest, exit({0, hip_height, z}, -Vec3::UnitY()).y());
  }
  return lowest;
}

}  // namespace vitrine::body
