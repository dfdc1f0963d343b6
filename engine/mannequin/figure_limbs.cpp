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

/// The thigh just below the crotch. Thighs keep apart, and do not stand out further than the hips: what breadth they
/// lose there they get back in depth.
Section Figure::thigh_of(const Measurements& m, const BodyPlan& plan) const {
  const double h = m.height, ratio = 1.12, widest = std::max(0.5 * (0.985 * hip_half_ - thigh_gap), 0.03 * h);
  Section thigh = station(m.inside_leg - 0.012 * h, 0, 0.006 * h, 0.96 * plan.thigh_girth, ratio, 0.52);
  if (thigh.a > widest) {
    const double girth = 0.75 * plan.thigh_girth + 0.25 * plan.thigh_girth * widest / thigh.a;
    thigh = station(thigh.s, 0, thigh.z, girth, ratio, 0.52);
    if (thigh.a > widest) {
      const double stretch = std::min(thigh.a / widest, 1.35);
      thigh.front *= stretch;
      thigh.back *= stretch;
      thigh.a = widest;
    }
  }
  thigh.x = thigh.a + thigh_gap;
  return thigh;
}

void Figure::make_leg(const Measurements& m, const BodyPlan& plan, const Unknowns&) {
  const double h = m.height, crotch = m.inside_leg, knee = std::min(plan.knee_height, 0.66 * crotch);
  const double gap = thigh_gap;
  crotch_y_ = crotch;
  knee_height = knee;
  ankle_height = 0.040 * h;
  const double below = knee / 0.2756;  // stretches the lower leg's stations with the knee's height
  const Section thigh = thigh_of(m, plan);
  const double foot_x = std::clamp(0.80 * thigh.x + 0.006 * h, 0.046 * h, 0.075 * h);
  const auto x_at = [&](double y) {
    const double t = std::clamp((thigh.s - y) / thigh.s, 0.0, 1.0);
    return thigh.x + (foot_x - thigh.x) * t;
  };
  const double lower = std::min(plan.lower_thigh_girth, 0.80 * plan.thigh_girth), calf = 0.98 * plan.calf_girth;
  const double ankle = 0.93 * plan.ankle_girth, knee_girth = std::min(0.91 * lower, 1.02 * calf);
  const auto girth_at = [&](double t) { return lower + t * (plan.thigh_girth - lower); };
  const double up = crotch - knee;
  std::vector<Section> s;
  // The calf is fullest higher outside than inside, and the thigh's outside bows: `aside` is that shift.
  const auto leg = [&](double y, double aside, double z, double girth, double shape, double front) {
    s.push_back(station(y, x_at(y) + aside * h, z * h, girth, shape, front));
  };
  leg(0.012 * h, 0, -0.0180, 1.12 * ankle, 1.20, 0.50);
  leg(0.038 * h, 0, -0.0180, 1.08 * ankle, 1.25, 0.50);
  leg(0.070 * h, 0, -0.0165, ankle, 1.22, 0.50);
  leg(0.100 * below, 0, -0.0150, ankle + 0.17 * (calf - ankle), 1.17, 0.48);
  leg(0.135 * below, -0.0006, -0.0130, ankle + 0.52 * (calf - ankle), 1.12, 0.46);
  leg(0.172 * below, -0.0012, -0.0110, ankle + 0.88 * (calf - ankle), 1.08, 0.44);
  leg(0.205 * below, 0.0002, -0.0095, calf, 1.07, 0.43);
  leg(0.238 * below, 0.0012, -0.0065, 0.55 * calf + 0.45 * knee_girth, 1.06, 0.45);
  leg(knee, -0.0006, -0.0010, knee_girth, 1.06, 0.50);
  leg(knee + 0.15 * up, -0.0006, 0.0020, 0.97 * lower, 1.06, 0.52);
  leg(knee + 0.40 * up, 0.0014, 0.0045, girth_at(0.30), 1.08, 0.54);
  leg(knee + 0.68 * up, 0.0014, 0.0060, girth_at(0.62), 1.10, 0.54);
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
  // Above the crotch the two legs fill the trunk's outline, so that one turns into the other without a seam. They stay
  // apart: how high the fork is decides alone where the crotch lies.
  for (const double y : {hip_height, hip_height + 0.045 * h, hip_height + 0.09 * h}) {
    const Section around = trunk_.at(y);
    Section section = thigh;
    section.s = y;
    section.a = 0.5 * (around.a - 0.5 * gap);
    section.x = around.a - section.a;
    section.z = around.z;
    section.front = 0.95 * around.front;
    section.back = 0.96 * around.back;
    s.push_back(section);
  }
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
  const double y = shoulder_height(plan) - shoulder;
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
  // `aside` moves the middle outwards and up: the deltoid caps the shoulder on that side alone.
  const auto add = [&](double t, double girth, double ratio, double aside = 0) {
    const double past = std::max(0.0, t - reach);
    s.push_back(station(t, aside * h, bend * past, girth, ratio));
  };
  const double round = 2 * pi * shoulder;
  add(-0.020 * h, 0.80 * round, 1.05, -0.005);
  add(0.000, 0.97 * round, 1.06, -0.001);
  add(0.16 * reach, 1.05 * round, 1.08, 0.0045);
  add(0.30 * reach, 1.00 * round, 1.08, 0.0050);
  add(0.48 * reach, 0.98 * biceps, 1.08, 0.0022);
  add(0.66 * reach, 0.94 * biceps, 1.08);
  add(0.86 * reach, 0.42 * biceps + 0.52 * forearm, 1.02);
  add(reach, 0.95 * forearm, 1.0);
  add(reach + 0.20 * u.forearm, forearm, 1.0, 0.0010);
  add(reach + 0.50 * u.forearm, 0.40 * wrist_girth + 0.58 * forearm, 1.05);
  add(reach + 0.80 * u.forearm, 0.88 * wrist_girth + 0.09 * forearm, 1.2);
  add(end, 0.98 * wrist_girth, 1.34);
  add(end + 0.10 * hand, 1.02 * wrist_girth, 1.55);
  arm_ = Loft(s, arm_root, arm_axis, arm_across, Vec3::UnitZ(), 0.008 * h, 0.012 * h);
  const Section at_elbow = arm_.at(reach), at_wrist = arm_.at(end);
  elbow = arm_root + reach * arm_axis + at_elbow.z * Vec3::UnitZ();
  wrist = arm_root + end * arm_axis + at_wrist.z * Vec3::UnitZ();

  // A mitten, palm to the body, hanging a little steeper than the arm.
  struct Mitten {
    double t, thick, wide;
  };
  const Mitten mitten[] = {{-0.06, 0.84, 0.66}, {0.08, 0.88, 0.84}, {0.26, 0.84, 0.97},
                           {0.44, 0.76, 1.02},  {0.62, 0.68, 0.98}, {0.78, 0.60, 0.86},
                           {0.89, 0.52, 0.68},  {0.96, 0.42, 0.46}, {1.00, 0.28, 0.24}};
  const double steeper = 12 * pi / 180;
  const Vec3 along =
      (std::cos(steeper) * arm_axis - std::sin(steeper) * arm_across + bend * Vec3::UnitZ()).normalized();
  Vec3 thin = (std::cos(steeper) * arm_across + std::sin(steeper) * arm_axis);
  thin = (thin - thin.dot(along) * along).normalized();
  Vec3 wide = thin.cross(along).z() > 0 ? thin.cross(along) : along.cross(thin);
  // A relaxed hand turns its thumb towards the body.
  const double pronation = 30 * pi / 180;
  const Vec3 back = std::cos(pronation) * thin + std::sin(pronation) * wide;
  wide = std::cos(pronation) * wide - std::sin(pronation) * thin;
  thin = back;
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
  thumb_.a = wrist + 0.16 * hand * along + 0.48 * palm * wide;
  thumb_.b = wrist + 0.52 * hand * along + 1.06 * palm * wide - 0.05 * hand * thin;
  thumb_.ra = 0.34 * palm;
  thumb_.rb = 0.27 * palm;

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
