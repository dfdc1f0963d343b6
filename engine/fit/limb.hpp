// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

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
/// chain of landmarks.
class LimbBend {
 public:
  /// `shift` takes panel coordinates to the body's x/y plane. Error: NO_LANDMARK.
  static Result<LimbBend> make(const TemplateLimb& limb, const Panel& panel, const Mannequin& mannequin,
                               const Vec2& shift);

  /// Where a placed (shifted) panel point goes; points that belong to the trunk stay.
  Vec2 operator()(const Vec2& placed) const;

 private:
  LimbBend(Polyline flat, Polyline body, std::vector<Vec2> region, Vec2 root_a, Vec2 root_b, double body_start,
           double blend)
      : flat_(std::move(flat)),
        body_(std::move(body)),
        region_(std::move(region)),
        root_a_(std::move(root_a)),
        root_b_(std::move(root_b)),
        body_start_(body_start),
        blend_(blend) {}
  Polyline flat_, body_;
  std::vector<Vec2> region_;  // the limb's part of the placed panel: both sides, the tip, closed by the root line
  Vec2 root_a_, root_b_;
  double body_start_;  // [m] arc length on the body's chain that the flat root line comes to lie at
  double blend_;       // [m] width of the soft hinge behind the root line
};

}  // namespace vitrine
