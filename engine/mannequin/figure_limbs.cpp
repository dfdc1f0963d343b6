// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "figure.hpp"

namespace vitrine::body {

namespace {

constexpr double pi = std::numbers::pi;

/// Station of a limb by its girth; `ratio` = depth / width.
Section station(double s, double x, double z, double girth, double ratio, double front_share = 0.5) {
  Section section;
  section.s = s;
  section.x = x;
  section.z = z;
  section.a = girth / section_girth(1, 2 * ratio * front_share, 2 * ratio * (1 - front_share), 2, 2);
  section.front = 2 * ratio * front_share * section.a;
  section.back = 2 * ratio * (1 - front_share) * section.a;
  return section;
}

}  // namespace

void Figure::make_leg(const Measurements& m, const BodyPlan& plan, const Unknowns&) {
  const double h = m.height, crotch = m.inside_leg, knee = std::min(plan.knee_height, 0.66 * crotch);
  crotch_y_ = crotch;
  knee_height = knee;
  ankle_height = 0.040 * h;
  const double below = knee / 0.2756;  // stretches the lower leg's stations with the knee's height
  const double ratio = 1.12;
  Section thigh = station(crotch - 0.012 * h, 0, -0.001 * h, plan.thigh_girth, ratio, 0.5);
  // Thighs keep apart, and do not stand out further than the hips.
  const double gap = 0.012;
  const double widest = std::max(0.5 * (hip_half_ - gap), 0.03 * h);
  if (thigh.a > widest) {
    const double girth = 0.75 * plan.thigh_girth + 0.25 * plan.thigh_girth * widest / thigh.a;
    thigh = station(thigh.s, 0, thigh.z, girth, ratio, 0.5);
    if (thigh.a > widest) {
      const double stretch = std::min(thigh.a / widest, 1.35);
      thigh.front *= stretch;
      thigh.back *= stretch;
      thigh.a = widest;
    }
  }
  thigh.x = thigh.a + gap;
  const double foot_x = std::clamp(0.82 * thigh.x + 0.006 * h, 0.046 * h, 0.075 * h);
  const auto x_at = [&](double y) {
    const double t = std::clamp((thigh.s - y) / thigh.s, 0.0, 1.0);
    return thigh.x + (foot_x - thigh.x) * t;
  };
  const double lower = std::min(plan.lower_thigh_girth, 0.80 * plan.thigh_girth), calf = plan.calf_girth;
  const double ankle = 0.96 * plan.ankle_girth, knee_girth = std::min(0.93 * lower, 1.04 * calf);
  const auto girth_at = [&](double t) { return lower + t * (plan.thigh_girth - lower); };
  std::vector<Section> s;
  s.push_back(station(0.012 * h, foot_x, -0.018 * h, 1.10 * ankle, 1.2));
  s.push_back(station(0.038 * h, foot_x, -0.018 * h, 1.06 * ankle, 1.25));
  s.push_back(station(0.070 * h, foot_x, -0.017 * h, ankle, 1.22, 0.50));
  s.push_back(station(0.115 * below, x_at(0.115 * h), -0.015 * h, ankle + 0.32 * (calf - ankle), 1.15, 0.49));
  s.push_back(station(0.160 * below, x_at(0.16 * h), -0.013 * h, ankle + 0.80 * (calf - ankle), 1.10, 0.47));
  s.push_back(station(0.203 * below, x_at(0.20 * h), -0.011 * h, calf, 1.08, 0.46));
  s.push_back(station(0.243 * below, x_at(0.24 * h), -0.006 * h, 0.45 * calf + 0.55 * knee_girth, 1.05, 0.50));
  s.push_back(station(knee, x_at(knee), -0.001 * h, knee_girth, 1.06, 0.52));
  s.push_back(station(knee + 0.17 * (crotch - knee), x_at(knee), 0.002 * h, lower, 1.06, 0.52));
  const double up = crotch - knee;
  s.push_back(station(knee + 0.45 * up, x_at(knee + 0.45 * up), 0.003 * h, girth_at(0.45), 1.08, 0.53));
  s.push_back(station(knee + 0.72 * up, x_at(knee + 0.72 * up), 0.001 * h, girth_at(0.80), 1.10, 0.52));
  // No thigh on the way up may reach past the middle, or stand out further than the hips: what breadth it loses there
  // it gets back in depth.
  for (Section& section : s) {
    const double below_hip = std::clamp((thigh.s - section.s) / (thigh.s - knee), 0.0, 1.0);
    const double room = 0.5 * (std::max(thigh.x + thigh.a, 0.94 * hip_half_) * (1 - 0.12 * below_hip) - gap);
    if (section.a > room) {
      const double stretch = std::min(section.a / room, 1.35);
      section.front *= stretch;
      section.back *= stretch;
      section.a = room;
    }
    if (section.x - section.a < gap) section.x = section.a + gap;
  }
  s.push_back(thigh);
  // Above the crotch the thigh follows the flank up to the hip joint and sinks into the trunk.
  Section hip = thigh;
  hip.s = hip_height;
  hip.a = 0.84 * thigh.a;
  hip.x = std::max(hip_half_ - hip.a, 0.3 * hip_half_);
  hip.front *= 0.90;
  hip.back *= 0.90;
  s.push_back(hip);
  const auto sink = [&](double rise, double width, double depth, double under) {
    Section section = hip;
    section.s = hip_height + rise;
    section.a *= width;
    section.x = std::max(trunk_.at(section.s).a - under - section.a, 0.2 * hip_half_);
    section.front *= depth;
    section.back *= depth;
    s.push_back(section);
  };
  sink(0.030 * h, 0.78, 0.75, 0.004 * h);
  sink(0.060 * h, 0.50, 0.50, 0.014 * h);
  sink(0.095 * h, 0.25, 0.25, 0.032 * h);
  leg_ = Loft(s, Vec3::Zero(), Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitZ(), 0.013 * h, 0.006);

  const double turn = 7 * pi / 180, length = plan.foot_length, half = 0.5 * plan.foot_breadth;
  const Vec3 ahead(std::sin(turn), 0, std::cos(turn)), aside(std::cos(turn), 0, -std::sin(turn));
  const Vec3 heel = Vec3(foot_x, 0, -0.018 * h) - 0.25 * length * ahead;
  struct Sole {
    double t, a, up;
  };
  const Sole sole[] = {{0.00, 0.35, 0.020}, {0.04, 0.56, 0.030}, {0.12, 0.68, 0.038}, {0.28, 0.70, 0.046},
                       {0.45, 0.78, 0.042}, {0.60, 0.94, 0.030}, {0.74, 1.00, 0.022}, {0.87, 0.88, 0.016},
                       {0.96, 0.60, 0.012}, {1.00, 0.30, 0.009}};
  std::vector<Section> f;
  for (const Sole& station_ : sole) {
    Section section;
    section.s = station_.t * length;
    section.x = -0.010 * length * std::sin(pi * station_.t);
    section.z = 0.008 * h;
    section.a = station_.a * half;
    section.front = station_.up * h - 0.25 * section.z;
    section.back = 0.030;
    section.n_front = 2.0;
    section.n_back = 2.2;
    f.push_back(section);
  }
  foot_ = Loft(f, heel, ahead, aside, Vec3::UnitY(), 0.006, 0.008);
}

void Figure::make_arm(const Measurements& m, const BodyPlan& plan, const Unknowns& u, double arm_angle) {
  const double h = m.height;
  const double biceps = 0.92 * plan.biceps_girth, forearm = 0.95 * plan.forearm_girth, wrist_girth = plan.wrist_girth;
  const double shoulder = shoulder_radius(plan);
  const double y = plan.acromion_height - shoulder;
  arm_root = Vec3(shoulder_half(plan), y, -0.004 * h);
  // The arm must clear the chest at the bust, where the tape and the garment pass: first it moves out, then it lifts.
  const double clear = chest_half_ + arm_gap;
  const auto inner = [&](double angle) {
    return arm_root.x() + (y - bust_height) * std::tan(angle) - 1.04 * shoulder / std::cos(angle);
  };
  double angle = arm_angle;
  if (inner(angle) < clear) arm_root.x() += std::min(0.6 * (clear - inner(angle)), shoulder_shift * h);
  while (inner(angle) < clear && angle < 65 * pi / 180) angle += 0.5 * pi / 180;
  arm_axis = Vec3(std::sin(angle), -std::cos(angle), 0);
  arm_across = Vec3(std::cos(angle), std::sin(angle), 0);

  const double reach = u.upper_arm, end = u.upper_arm + u.forearm, bend = std::tan(8 * pi / 180);
  const double hand = plan.hand_length, palm = 0.5 * plan.hand_breadth;
  std::vector<Section> s;
  const auto add = [&](double t, double girth, double ratio) {
    const double past = std::max(0.0, t - reach);
    s.push_back(station(t, 0, bend * past, girth, ratio));
  };
  const double round = 2 * pi * shoulder;
  add(-0.020 * h, 0.80 * round, 1.05);
  add(0.000, 0.97 * round, 1.05);
  add(0.14 * reach, round, 1.06);
  add(0.35 * reach, 0.99 * biceps, 1.06);
  add(0.60 * reach, 0.96 * biceps, 1.06);
  add(0.85 * reach, 0.45 * biceps + 0.52 * forearm, 1.02);
  add(reach, 0.96 * forearm, 1.0);
  add(reach + 0.20 * u.forearm, forearm, 1.0);
  add(reach + 0.50 * u.forearm, 0.45 * wrist_girth + 0.55 * forearm, 1.05);
  add(reach + 0.80 * u.forearm, 0.88 * wrist_girth + 0.14 * forearm, 1.2);
  add(end, wrist_girth, 1.32);
  add(end + 0.12 * hand, 1.02 * wrist_girth, 1.5);
  arm_ = Loft(s, arm_root, arm_axis, arm_across, Vec3::UnitZ(), 0.008 * h, 0.012 * h);
  const Section at_elbow = arm_.at(reach), at_wrist = arm_.at(end);
  elbow = arm_root + reach * arm_axis + at_elbow.z * Vec3::UnitZ();
  wrist = arm_root + end * arm_axis + at_wrist.z * Vec3::UnitZ();

  // A mitten, palm to the body, hanging a little steeper than the arm.
  struct Mitten {
    double t, thick, wide;
  };
  const Mitten mitten[] = {{-0.06, 0.80, 0.66}, {0.10, 0.84, 0.78}, {0.30, 0.80, 0.98}, {0.50, 0.72, 1.00},
                           {0.70, 0.60, 0.90},  {0.88, 0.48, 0.66}, {1.00, 0.32, 0.34}};
  const double steeper = 12 * pi / 180;
  const Vec3 along =
      (std::cos(steeper) * arm_axis - std::sin(steeper) * arm_across + bend * Vec3::UnitZ()).normalized();
  Vec3 thin = (std::cos(steeper) * arm_across + std::sin(steeper) * arm_axis);
  thin = (thin - thin.dot(along) * along).normalized();
  const Vec3 wide = thin.cross(along).z() > 0 ? thin.cross(along) : along.cross(thin);
  std::vector<Section> g;
  for (const Mitten& part : mitten) {
    Section section;
    section.s = part.t * hand;
    section.x = -0.05 * hand * part.t * part.t;
    section.a = 0.48 * palm * part.thick;
    section.front = section.back = palm * part.wide;
    section.n_front = section.n_back = 2.0;
    g.push_back(section);
  }
  hand_ = Loft(g, wrist, along, thin, wide, 0.006, 0.005);
  thumb_.a = wrist + 0.14 * hand * along + 0.45 * palm * wide;
  thumb_.b = wrist + 0.50 * hand * along + 1.05 * palm * wide - 0.06 * hand * thin;
  thumb_.ra = 0.36 * palm;
  thumb_.rb = 0.30 * palm;

  // Where the arm's lower edge runs into the chest's side.
  const double down = (chest_half_ - inner(angle) + (y - bust_height) * std::tan(angle)) / std::tan(angle);
  armpit_ = Vec3(chest_half_, y - std::max(down, 0.0), 0);
  arm_blend_ = 0.045;
  arm_free_ = 0.085 * h / std::cos(angle);
  // The girdle carries the slope from the side of the neck to the acromion.
  const double neck_half = m.neck_base / (2 * pi);
  girdle_.ra = 0.026 * h;
  girdle_.rb = 0.97 * shoulder;
  girdle_.a = Vec3(0.6 * neck_half, neck_base.y() - 0.003 * h - girdle_.ra, -0.006 * h);
  girdle_.b = arm_root + Vec3(-0.15 * shoulder, 0, 0);
}

}  // namespace vitrine::body
