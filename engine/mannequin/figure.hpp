// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "anthropometry.hpp"
#include "loft.hpp"

namespace vitrine::body {

/// What the solver turns until the tape reads what was asked for [m].
struct Unknowns {
  double under_bust = 0, waist = 0, hip = 0;  ///< girths of the bare trunk loft
  double bust = 0;                            ///< what the bust adds to the under-bust: chest and breasts grow with it
  double neck = 0;                            ///< girth of the neck loft at its base
  double crotch = 0;                          ///< height of the trunk's lower end
  double upper_arm = 0, forearm = 0;          ///< along the arm's axis
};

/// The built-in body as a solid: a smooth union of lofts and ellipsoids. Right is x > 0; the left is its mirror image.
class Figure {
 public:
  Figure(const Measurements& m, const BodyPlan& plan, double arm_angle, const Unknowns& unknowns);

  /// First-order signed distance [m], negative inside; exact only on the surface.
  double distance(const Vec3& p) const;
  /// First surface point on the ray from the inside point `from`; `from` itself if it is outside.
  Vec3 exit(const Vec3& from, const Vec3& direction) const;
  /// First surface point on the way from `reach` [m] back to `centre`; `centre` itself where there is none.
  Vec3 entry(const Vec3& centre, const Vec3& direction, double reach) const;
  /// Hull perimeter of the section through `centre`, spanned by the unit vectors u and v [m]. With `reach` > 0 the
  /// section is felt from that far outside: just above the crotch it is no star about its middle.
  double tape(const Vec3& centre, const Vec3& u, const Vec3& v, double reach = 0) const;
  double hip_reach() const { return 1.3 * hip_half_ + 0.05; }
  /// Height of the lowest point of the trunk between the legs.
  double crotch_height() const;
  Vec3 leg_centre(double height) const;  ///< middle of the right leg
  /// How fine the triangles should be here: 1 on the trunk, less on hands, feet and head.
  double detail(const Vec3& p) const;

  // Where things are; heights and points [m].
  double bust_height = 0, under_bust_height = 0, waist_height = 0, hip_height = 0;
  double hips_low = 0, hips_high = 0;  ///< between these levels the hips are measured where they are fullest
  double knee_height = 0, ankle_height = 0;
  double bust_apart = 0;                    ///< half the distance of the bust points
  double breast = 0;                        ///< how far the breasts stand out of the chest
  Vec3 neck_base, neck_axis, neck_forward;  ///< neck_forward lies in the neck-base plane
  Vec3 arm_root, arm_axis, arm_across, elbow, wrist;
  Vec3 low, high;  ///< box that holds the body

 private:
  struct Blob {
    Vec3 centre = Vec3::Zero();
    double x = 0, up = 0, down = 0, z = 0;  ///< radii
  };
  struct Cone {
    Vec3 a = Vec3::Zero(), b = Vec3::Zero();
    double ra = 0, rb = 0;
  };
  /// What the breasts add to the chest, or the chest muscles.
  struct Hill {
    double up = 1, down = 1, inside = 1, outside = 1;  ///< [m] how far each reaches from its bust point
    double side = 0, front = 1;                        ///< [m] depths between which the chest begins to rise
  };
  static double blob(const Blob& s, const Vec3& p);
  static double cone(const Cone& c, const Vec3& p);
  double raised(double d, const Vec3& near) const;
  double head(const Vec3& p) const;
  double leg_side(const Vec3& p) const;
  double arm_side(const Vec3& p) const;
  double shoulder_radius(const BodyPlan& plan) const;
  double shoulder_height(const BodyPlan& plan) const;  ///< [m] of the acromion
  double shoulder_half(const BodyPlan& plan) const;    ///< [m] from the middle to the arm's root
  double highest_bust(const Measurements& m, const BodyPlan& plan) const;
  void make_trunk(const Measurements& m, const BodyPlan& plan, const Unknowns& u);
  void make_head(const Measurements& m, const BodyPlan& plan, const Unknowns& u);
  Section thigh_of(const Measurements& m, const BodyPlan& plan) const;
  void make_leg(const Measurements& m, const BodyPlan& plan, const Unknowns& u);
  void make_arm(const Measurements& m, const BodyPlan& plan, const Unknowns& u, double arm_angle);

  static constexpr double arm_gap = 0.024;         ///< [m] between arm and chest at the bust
  static constexpr double shoulder_shift = 0.025;  ///< [-] of the height: how far a wide chest pushes the arms out
  static constexpr double thigh_gap = 0.012;       ///< [m] between a thigh and the middle
  double fork_low_ = 0, fork_high_ = 0;            ///< [m] heights between which the legs turn into the trunk
  double crotch_y_ = 0;                            ///< [m] height asked for
  Vec3 armpit_ = Vec3::Zero();                     ///< about where chest and arm meet
  double height_ = 0, hip_half_ = 0, chest_half_ = 0;
  bool woman_ = true;
  double arm_blend_ = 0, arm_free_ = 0;  ///< blend at the shoulder, and the way along the arm over which it fades
  Loft trunk_, leg_, foot_, arm_, hand_, neck_;
  Hill bosom_;
  Blob seat_, skull_, face_;
  Cone girdle_, thumb_;
};

}  // namespace vitrine::body
