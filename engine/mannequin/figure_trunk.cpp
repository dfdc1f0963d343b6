// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "figure.hpp"

namespace vitrine::body {

namespace {

/// Depth / breadth of a section: the survey's ratio at the reference girth, deeper as the girth grows (anatomy: fat
/// goes in front and behind; breadth follows the bones).
double depth_ratio(double ratio, double girth, double reference, double growth = 0.24) {
  return ratio * std::pow(girth / reference, growth);
}

Section sized(double s, double girth, double ratio, double z, double front_share, double n_front, double n_back) {
  Section section;
  section.s = s;
  section.z = z;
  section.n_front = n_front;
  section.n_back = n_back;
  const double unit = section_girth(1, 2 * ratio * front_share, 2 * ratio * (1 - front_share), n_front, n_back);
  section.a = girth / unit;
  section.front = 2 * ratio * front_share * section.a;
  section.back = 2 * ratio * (1 - front_share) * section.a;
  return section;
}

}  // namespace

double Figure::shoulder_radius(const BodyPlan& plan) const {
  return 1.10 * 0.92 * plan.biceps_girth / (2 * std::numbers::pi);
}

double Figure::shoulder_half(const BodyPlan& plan) const {
  return 0.5 * plan.biacromial + (woman_ ? -0.004 : 0.004) * height_;
}

/// The survey's acromion is bone under a standing soldier's raised shoulder; a shop's figure lets it fall a little, so
/// that the line from the neck slopes by some twenty degrees, as patterns expect.
double Figure::shoulder_height(const BodyPlan& plan) const {
  return plan.acromion_height - 0.007 * height_;
}

/// The level below which an arm at 50 degrees leaves a chest of this girth free: a broad chest under low shoulders is
/// measured a little further down.
double Figure::highest_bust(const Measurements& m, const BodyPlan& plan) const {
  constexpr double steepest = 50 * std::numbers::pi / 180;
  const double radius = shoulder_radius(plan), chest_half = 0.180 * m.bust;
  const double outside = chest_half + arm_gap + 1.04 * radius / std::cos(steepest) - shoulder_half(plan);
  return shoulder_height(plan) - radius - (outside - 0.5 * shoulder_shift * height_) / std::tan(steepest);
}

Figure::Figure(const Measurements& m, const BodyPlan& plan, double arm_angle, const Unknowns& u) {
  height_ = m.height;
  woman_ = m.sex == "woman";
  const double h = m.height;
  hip_height = std::clamp(plan.hip_height, m.inside_leg + 0.034 * h, m.inside_leg + 0.055 * h);
  waist_height = std::clamp(plan.waist_height(), hip_height + 0.085 * h, hip_height + 0.16 * h);
  bust_height = std::clamp(plan.bust_height, waist_height + 0.075 * h, std::max(waist_height + 0.075 * h, 0.735 * h));
  bust_height = std::max(std::min(bust_height, highest_bust(m, plan)), 0.68 * h);
  if (bust_height < waist_height + 0.07 * h) waist_height = bust_height - 0.07 * h;
  under_bust_height = bust_height - (woman_ ? 0.036 : 0.035) * h;
  hips_low = m.inside_leg + 0.008 * h;
  hips_high = std::max(hip_height, 0.56 * h);
  make_trunk(m, plan, u);
  make_head(m, plan, u);
  make_leg(m, plan, u);
  make_arm(m, plan, u, arm_angle);
  low = Vec3(-wrist.x() - 0.25, -0.02, -0.35);
  high = Vec3(wrist.x() + 0.25, h + 0.02, 0.45);
}

void Figure::make_trunk(const Measurements& m, const BodyPlan& plan, const Unknowns& u) {
  const double h = m.height;
  const double chest_girth = u.under_bust + (woman_ ? 0.48 : 1.0) * u.bust;
  const double ratio_hip = depth_ratio(woman_ ? 0.655 : 0.70, u.hip, (woman_ ? 0.60 : 0.57) * h);
  const double ratio_waist = depth_ratio(woman_ ? 0.70 : 0.735, u.waist, (woman_ ? 0.47 : 0.50) * h);
  const double ratio_ribs = depth_ratio(woman_ ? 0.72 : 0.70, u.under_bust, (woman_ ? 0.49 : 0.55) * h, 0.16);
  const double ratio_chest = depth_ratio(woman_ ? 0.74 : 0.70, chest_girth, (woman_ ? 0.51 : 0.58) * h, 0.12);
  // A large waist stands out in front.
  const double belly = std::clamp((u.waist / h - 0.44) * 0.42, 0.0, 0.11);
  const double y1 = hip_height, y2 = waist_height, y3 = under_bust_height, y4 = bust_height;

  std::vector<Section> s;
  const Section hip = sized(y1, u.hip, ratio_hip, 0.004 * h, 0.485 + 0.3 * belly, 2.3, 2.3);
  hip_half_ = hip.a;
  // From the hips downwards the trunk is the outline of both thighs, which it turns into over this height.
  fork_low_ = std::clamp(u.crotch - 0.012 * h, m.inside_leg - 0.06 * h, m.inside_leg + 0.03 * h);
  fork_high_ = m.inside_leg + 0.054 * h;
  const Section thigh = thigh_of(m, plan);
  Section thighs = hip;
  thighs.a = thigh.x + thigh.a;
  thighs.z = thigh.z;
  thighs.front = 1.03 * thigh.front;
  thighs.back = 1.03 * thigh.back;
  for (const double below : {0.05, 0.0}) {
    thighs.s = thigh.s - below * h;
    s.push_back(thighs);
  }
  s.push_back(hip);
  // Differences of girth, not ratios, run from landmark to landmark; the S-curves keep hips round and the waist soft.
  const auto between = [&](double t, double share) {
    const double y = y1 + t * (y2 - y1);
    const double girth = u.waist + share * (u.hip - u.waist);
    const double w = 1 - t;
    s.push_back(sized(y, girth, ratio_waist + w * (ratio_hip - ratio_waist),
                      ((woman_ ? 0.020 : 0.012) - (woman_ ? 0.016 : 0.008) * w) * h,
                      0.52 + belly * (1 - w * w) - 0.035 * w * w, 2.3, 2.35));
  };
  // Where the waist is larger than the hips, the belly begins above them.
  const bool belly_first = u.waist > u.hip;
  between(0.25, belly_first ? 1.0 : 0.88);
  between(0.50, belly_first ? 0.95 : 0.60);
  between(0.75, belly_first ? 0.40 : 0.24);
  s.push_back(sized(y2, u.waist, ratio_waist, (woman_ ? 0.020 : 0.012) * h, 0.52 + belly, 2.25, 2.4));
  s.push_back(sized(y2 + 0.5 * (y3 - y2), u.waist + 0.48 * (u.under_bust - u.waist), 0.5 * (ratio_waist + ratio_ribs),
                    (woman_ ? 0.0195 : 0.012) * h, 0.52 + 0.95 * belly, 2.3, 2.5));
  s.push_back(sized(y3, u.under_bust, ratio_ribs, (woman_ ? 0.018 : 0.013) * h, 0.515 + 0.75 * belly, 2.35, 2.6));
  const Section chest = sized(y4, chest_girth, ratio_chest, (woman_ ? 0.017 : 0.014) * h,
                              (woman_ ? 0.52 : 0.50) + 0.5 * belly, woman_ ? 2.3 : 2.5, 2.6);
  s.push_back(chest);
  chest_half_ = chest.a;
  // Above the bust the bones decide: the trunk closes in a dome under the shoulder girdle.
  const double y5 = std::max(plan.axilla_height, y4 + 0.025 * h), top = shoulder_height(plan);
  const double upper = 0.5 * (0.80 * 0.5 * plan.biacromial + chest.a);
  const double bony_front = std::min(chest.front, 0.072 * h), bony_back = std::min(chest.back, 0.072 * h);
  const auto dome = [&](double y, double a, double front, double back, double soft, double z) {
    Section section = chest;
    section.s = y;
    section.a = a;
    section.front = front * (bony_front + soft * (chest.front - bony_front));
    section.back = back * (bony_back + soft * (chest.back - bony_back));
    section.z = z * h;
    s.push_back(section);
  };
  const double rise = top - y5;
  dome(y5, upper, 0.98, 0.98, 0.80, 0.008);
  dome(y5 + 0.40 * rise, 0.90 * upper, 0.86, 0.92, 0.50, 0.002);
  dome(y5 + 0.75 * rise, 0.72 * upper, 0.72, 0.80, 0.25, -0.002);
  dome(y5 + 1.00 * rise, 0.52 * upper, 0.60, 0.66, 0.10, -0.002);
  dome(y5 + 1.20 * rise, 0.30 * upper, 0.45, 0.50, 0.00, -0.002);
  trunk_ = Loft(s, Vec3::Zero(), Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitZ(), 0.014 * h, 0.012 * h);

  // On a man the same shape, shallow and broad, makes the chest muscles.
  breast = woman_ ? std::max(0.0, 0.30 * u.bust / (1 + std::max(u.bust, 0.0) / 0.80)) : 0.007 * h;
  bust_apart = (woman_ ? 0.50 : 0.46) * chest.a;
  bosom_.up = (woman_ ? 0.085 : 0.065) * h;
  // A heavy breast falls back to the ribs over a longer way, or it would overhang.
  bosom_.down = (woman_ ? 0.048 : 0.050) * h + std::max(0.0, 0.20 * (breast - 0.025));
  bosom_.inside = (woman_ ? 0.65 : 0.56) * chest.a;
  bosom_.outside = (woman_ ? 0.50 : 0.56) * chest.a;
  bosom_.side = chest.z;
  bosom_.front = chest.z + 0.75 * chest.front;

  const double behind = hip.z - hip.back;
  seat_.centre = Vec3(0.44 * hip.a, y1 - 0.002 * h, behind + 0.050 * h);
  seat_.x = 0.40 * hip.a;
  seat_.up = 0.066 * h;
  seat_.down = 0.052 * h;
  seat_.z = 0.048 * h;
}

void Figure::make_head(const Measurements& m, const BodyPlan& plan, const Unknowns& u) {
  const double h = m.height;
  const double front = plan.suprasternal_height + 0.009 * h, back = plan.c7_height + 0.003 * h;
  const double base = u.neck / (2 * std::numbers::pi);
  // The neck-base plane falls from C7 to the pit of the throat; the neck leans forward out of it.
  const double depth = 2.08 * m.neck_base / (2 * std::numbers::pi);
  const double tilt = std::asin(std::clamp((back - front) / depth, 0.15, 0.55));
  neck_base = Vec3(0, 0.5 * (front + back), 0.008 * h);
  neck_forward = Vec3(0, -std::sin(tilt), std::cos(tilt));
  const double lean = 0.22;
  neck_axis = Vec3(0, std::cos(lean), std::sin(lean));
  const double middle = std::min(0.94 * plan.neck_girth / (2 * std::numbers::pi), 0.93 * base);
  std::vector<Section> s(5);
  const double at[] = {-0.045 * h, -0.005 * h, 0.022 * h, 0.05 * h, 0.10 * h};
  const double radius[] = {1.10 * base, base, 0.35 * base + 0.65 * middle, middle, middle};
  for (int i = 0; i < 5; ++i) {
    s[i].s = at[i];
    s[i].a = 0.98 * radius[i];
    s[i].front = s[i].back = 1.02 * radius[i];
  }
  neck_ = Loft(s, neck_base, neck_axis, Vec3::UnitX(), Vec3(0, -std::sin(lean), std::cos(lean)), 0.008 * h, 0.01);

  // The skull, and before and below it the face down to the chin; the neck meets them behind the jaw.
  const double chin = h - (woman_ ? 0.131 : 0.130) * h, tall = h - chin;
  const double along = (0.925 * h - neck_base.y()) / std::cos(lean);
  const double middle_z = neck_base.z() + along * std::sin(lean) + 0.002 * h;
  skull_.up = 0.46 * tall;
  skull_.down = 0.46 * tall;
  skull_.centre = Vec3(0, h - skull_.up, middle_z - 0.004 * h);
  skull_.x = 0.49 * plan.head_breadth;
  skull_.z = 0.49 * plan.head_depth;
  face_.up = 0.44 * tall;
  face_.down = 0.41 * tall;
  face_.centre = Vec3(0, chin + face_.down, middle_z + 0.145 * plan.head_depth);
  face_.x = 0.36 * plan.head_breadth;
  face_.z = 0.35 * plan.head_depth;
}

}  // namespace vitrine::body
