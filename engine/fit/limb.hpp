// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "gaps.hpp"
#include "vitrine/model/body.hpp"
#include "vitrine/model/garment_template.hpp"
#include "vitrine/model/panel.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

/// A line of points with its arc length; the last piece runs on beyond its end.
class Polyline {
 public:
  explicit Polyline(std::vector<Vec2> points);
  double length() const { return arc_.back(); }
  /// Point and unit tangent at arc length s; s < 0 and s > length() run on straight.
  Vec2 at(double s, Vec2& tangent) const;
  /// Arc length of the nearest point, and the signed offset to the left of the tangent.
  void project(const Vec2& p, double& s, double& offset) const;

 private:
  std::vector<Vec2> points_;
  std::vector<double> arc_;
};

/// Turns the part of a panel that belongs to a limb (a sleeve, a trouser leg) from its flat middle line to the body's
/// limb, and lays it as half a tube around it, so that its seams start next to each other and on either side of the
/// limb.
class LimbBend {
 public:
  /// `shift` takes panel coordinates to the body's x/y plane; `clearance` [m] from the limb. Error: NO_LANDMARK.
  static Result<LimbBend> make(const TemplateLimb& limb, const Panel& panel, const Mannequin& mannequin,
                               const DistanceField& field, const Vec2& shift, double clearance);

  /// How much a placed (shifted) panel point belongs to the limb: 0 on the trunk, rising to 1 behind the root line.
  double weight(const Vec2& placed) const;
  /// Where it goes on the limb's half tube; outwards is +1 for a front panel, -1 for a back panel.
  /// It stays on the limb's own side of x = 0, and inside the arms where the limb hangs between them.
  Vec3 on_limb(const Vec2& placed, double outwards, const Gaps& gaps) const;

 private:
  struct Ring {
    Vec3 centre;
    double radius;  // [m] of the limb itself
  };
  LimbBend() : flat_({Vec2::Zero(), Vec2::UnitX()}), body_({Vec2::Zero(), Vec2::UnitX()}) {}
  void find_rings(const DistanceField& field, const std::vector<Vec3>& chain);

  Polyline flat_, body_;            // middle lines; body_ in the x/y plane
  std::vector<double> half_width_;  // [m] of the flat limb, at equal steps from root to tip
  std::vector<Ring> rings_;         // at equal steps along body_
  std::vector<Vec2> region_;        // the limb's part of the placed panel, closed by the root line
  Vec2 root_a_ = Vec2::Zero(), root_b_ = Vec2::Zero();
  double body_start_ = 0;  // [m] arc length on the body's chain that the flat root line comes to lie at
  double blend_ = 0;       // [m] width of the soft hinge behind the root line
  double clearance_ = 0;
};

}  // namespace vitrine
