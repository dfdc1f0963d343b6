// SPDX-License-Identifier: GPL-3.0-or-later
#include "lights.hpp"

#include <algorithm>
#include <cmath>

#include "vitrine/sampling.hpp"

namespace vitrine {
namespace {

// (right, up, back) of the camera.
const Vec3 kKey = Vec3(-0.58, 0.62, 0.62).normalized();
const Vec3 kFill = Vec3(0.60, 0.15, 0.78).normalized();
constexpr double kKeyPower = 0.78, kFillPower = 0.12, kSky = 0.54;
constexpr double kKeySpread = 0.22;  // tangent of the softbox' half angle
constexpr double kSkyBelow = 0.62;   // light from below against light from above
constexpr double kInnerSide = 0.72;  // cloth seen from inside gets what comes through
constexpr double kThrough = 0.30;    // and where it faces the body closely: light through the cloth and between the two
constexpr double kReach = 0.32;      // [m] how far folds and limbs shade each other
constexpr double kFloorDark = 0.75;  // how dark a fully covered floor gets
constexpr double kFloorCast = 0.10;  // the key light's own shadow on it
constexpr double kFarthest = 10.0;   // [m] across any subject
constexpr float kShoulder = 0.76F;   // linear; sRGB 226
constexpr float kBackdrop = 0.735F;  // linear; sRGB 223: white cloth still stands out

}  // namespace

Colour backdrop() {
  return Colour::Constant(kBackdrop);
}

Colour shoulder(const Colour& c) {
  const float top = c.maxCoeff();
  if (top <= kShoulder) return c;
  const float room = 1.0F - kShoulder;
  return c * ((kShoulder + room * (1.0F - std::exp((kShoulder - top) / room))) / top);
}

Lights::Lights(const Tracer& tracer, const Camera& camera, int rays)
    : tracer_(tracer), rays_(rays), sky_(tracer, rays, kReach), sky_over_floor_(tracer, 4 * rays, kFloorReach) {
  const auto world = [&](const Vec3& l) {
    return Vec3(l.x() * camera.right + l.y() * camera.up + l.z() * camera.back);
  };
  key_ = world(kKey);
  fill_ = world(kFill);
}

float Lights::lit(const Vec3& point, double spread, int rays, int x, int y) const {
  const Sequence sequence(x, y, 2);
  const int open = tracer_.count_free(point, rays, [&](int k) {
    return std::pair(cone_direction(key_, spread, sequence.point(k)), double{kFarthest});
  });
  return static_cast<float>(open) / static_cast<float>(rays);
}

Visibility Lights::see(const Vec3& start, const Vec3& normal, double baked, int x, int y) const {
  Visibility v;
  if (baked >= 0)
    v.open = static_cast<float>(baked);
  else if (rays_ > 0)
    v.open = static_cast<float>(sky_.open(start, normal, Sequence(x, y, 1)));
  v.key = normal.dot(key_) > -0.1 ? lit(start, kKeySpread, std::max(1, rays_ / 3), x, y) : 0.0F;
  return v;
}

float Lights::floor_shadow(const Vec3& point, int x, int y) const {
  // Few points are asked for the floor's soft shadow, so that each may cost four times as much.
  const Vec3 start = point + kLift * Vec3::UnitY();
  const double covered = rays_ > 0 ? 1.0 - sky_over_floor_.open(start, Vec3::UnitY(), Sequence(x, y, 1)) : 0.0;
  const double shadowed = 1.0 - lit(start, 2.0 * kKeySpread, std::max(1, 2 * rays_), x, y);
  return static_cast<float>(std::min(1.0, kFloorDark * covered + kFloorCast * shadowed));
}

float Lights::shade(const Vec3& normal, const Visibility& seen, bool inner) const {
  double light = kSky * seen.open * (kSkyBelow + (1.0 - kSkyBelow) * (0.5 + 0.5 * normal.y()));
  light += kFillPower * std::max(0.0, normal.dot(fill_)) * seen.open;
  light += kKeyPower * std::max(0.0, normal.dot(key_)) * seen.key;
  // Without it the inside of a collar would be black and not of the garment's own colour.
  if (inner) light += kThrough * (1.0 - seen.open);
  return static_cast<float>(inner ? kInnerSide * light : light);
}

}  // namespace vitrine
