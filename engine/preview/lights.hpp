// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "camera.hpp"
#include "texture_lookup.hpp"
#include "vitrine/rays.hpp"

namespace vitrine {

/// How much light comes to a point, before its direction counts.
struct Visibility {
  float open = 1;  ///< [-] of the sky over it, cosine-weighted
  float key = 1;   ///< [-] of the key light's softbox
};

/// The lamps of the studio, as they stand for one view: with the camera, so that every view is lit alike.
class Lights {
 public:
  Lights(const Tracer& tracer, const Camera& camera, int rays);

  /// Rays from a point; `x`, `y` name the place in the picture that the rays' pattern belongs to. Openness that is
  /// known already (`baked` >= 0) is taken as it is.
  Visibility see(const Vec3& start, const Vec3& normal, double baked, int x, int y) const;
  /// How dark the floor is under and beside the subject, 0 to 1.
  float floor_shadow(const Vec3& point, int x, int y) const;
  /// Light that leaves matte white cloth.
  float shade(const Vec3& normal, const Visibility& seen, bool inner) const;

 private:
  float lit(const Vec3& point, double spread, int rays, int x, int y) const;

  const Tracer& tracer_;
  Vec3 key_, fill_;
  int rays_;
  Sky sky_, sky_over_floor_;
};

constexpr double kLift = 6e-4;        ///< [m] off the surface; the cloth lies 4 mm off the body
constexpr double kFloorReach = 0.45;  ///< [m] of the contact shadow

/// The empty studio.
Colour backdrop();
/// Below a knee colours stay exactly what they are; above, the brightest channel runs towards 1 without reaching it, so
/// that folds in white cloth are not burnt out. All channels shrink alike: hues stay.
Colour shoulder(const Colour& c);

}  // namespace vitrine
