// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "figure.hpp"
#include "marching.hpp"
#include "mesh_check.hpp"
#include "remesh.hpp"
#include "slice.hpp"

namespace vitrine {

namespace body {
namespace {

/// Where the tape runs, so that solver and report measure alike.
struct Tapes {
  double under_bust, bust, waist, hip, neck;
};

Tapes read_tapes(const Figure& f) {
  const auto level = [&f](double y) { return f.tape({0, y, 0.01}, Vec3::UnitX(), Vec3::UnitZ()); };
  return {level(f.under_bust_height), level(f.bust_height), level(f.waist_height), level(f.hip_height),
          f.tape(f.neck_base, Vec3::UnitX(), f.neck_forward)};
}

Vec3 acromion_of(const Figure& f) {
  return f.exit(f.arm_root, Vec3::UnitY());
}

Unknowns first_guess(const Measurements& m) {
  Unknowns u;
  u.under_bust = m.under_bust;
  u.waist = m.waist;
  u.hip = m.hip;
  u.bust = m.bust - m.under_bust;
  u.neck = m.neck_base;
  u.crotch = m.inside_leg;
  u.upper_arm = 0.55 * m.arm;
  u.forearm = 0.437 * m.arm;
  return u;
}

using Vec8 = Eigen::Matrix<double, 8, 1>;

Vec8 pack(const Unknowns& u) {
  Vec8 x;
  x << u.under_bust, u.bust, u.waist, u.hip, u.neck, u.crotch, u.upper_arm, u.forearm;
  return x;
}

Unknowns unpack(const Vec8& x) {
  return {.under_bust = x[0],
          .waist = x[2],
          .hip = x[3],
          .bust = x[1],
          .neck = x[4],
          .crotch = x[5],
          .upper_arm = x[6],
          .forearm = x[7]};
}

/// Turns the unknowns until the solid built from `m` has the girths in `aim`: Broyden's method, starting from what the
/// tapes would answer on a bare loft. Gives what is left to miss [m], in the order of `pack`.
Vec8 solve(const Measurements& m, const Measurements& aim, const BodyPlan& plan, double arm_angle, Unknowns& u) {
  const auto missed = [&](const Vec8& x) {
    const Figure f(m, plan, arm_angle, unpack(x));
    const Tapes t = read_tapes(f);
    const double upper = (f.elbow - acromion_of(f)).norm(), fore = (f.wrist - f.elbow).norm();
    Vec8 miss;
    miss << aim.under_bust - t.under_bust, aim.bust - t.bust, aim.waist - t.waist, aim.hip - t.hip,
        aim.neck_base - t.neck, aim.inside_leg - f.crotch_height(), 0.563 * m.arm - upper, 0.437 * m.arm - fore;
    return miss;
  };
  Vec8 x = pack(u), miss = missed(x), best = miss;
  // Inverse of d(tape) / d(unknown); the bust tape goes around under-bust plus bust.
  Eigen::Matrix<double, 8, 8> inverse = Eigen::Matrix<double, 8, 8>::Identity();
  inverse(1, 0) = -1;
  for (int round = 0; round < 16 && miss.cwiseAbs().maxCoeff() > 2e-4; ++round) {
    const Vec8 step = (inverse * miss).cwiseMax(-0.05).cwiseMin(0.05);
    const Vec8 next = x + step, left = missed(next);
    if (!left.allFinite()) break;
    const Vec8 change = miss - left, answered = inverse * change;
    const double weight = step.dot(answered);
    if (std::abs(weight) > 1e-12) inverse += (step - answered) * (step.transpose() * inverse) / weight;
    x = next;
    miss = left;
    if (miss.cwiseAbs().maxCoeff() < best.cwiseAbs().maxCoeff()) {
      best = miss;
      u = unpack(x);
    }
  }
  return best;
}

double widest_tape(const TriMesh& mesh, const Vec3& at, const Vec3& normal) {
  double tape = 0;
  for (const Ring& ring : slice(mesh, at, normal))
    if (ring.holds(at)) tape = std::max(tape, ring.tape);
  return tape;
}

/// The lowest point of the trunk between the legs: the section in the middle plane holds no leg.
Vec3 crotch_of(const TriMesh& mesh, const Vec3& inside) {
  Vec3 lowest = inside;
  for (const Ring& ring : slice(mesh, inside, Vec3::UnitX()))
    for (const Vec3& p : ring.points)
      if (p.y() < lowest.y()) lowest = p;
  return lowest;
}

/// Takes out the last fraction of a millimetre of meshing: soles on y = 0, crown at the height.
void stand(TriMesh& mesh, double height) {
  double low = mesh.vertices.front().y(), high = low;
  for (const Vec3& v : mesh.vertices) {
    low = std::min(low, v.y());
    high = std::max(high, v.y());
  }
  for (Vec3& v : mesh.vertices) v.y() = (v.y() - low) * (height / (high - low));
}

void set_pair(Mannequin& body, const std::string& name, const Vec3& right) {
  body.landmarks[name + "_right"] = right;
  body.landmarks[name + "_left"] = Vec3(-right.x(), right.y(), right.z());
}

void describe(const Figure& f, const Measurements& m, const BodyPlan& plan, Mannequin& body) {
  auto& mark = body.landmarks;
  const Vec3 x = Vec3::UnitX(), z = Vec3::UnitZ();
  const auto side = [&](double level) {
    Vec3 best = Vec3::Zero();
    for (double depth = -0.10; depth <= 0.1001; depth += 0.005) {
      const Vec3 inside(0, level, depth);
      if (f.distance(inside) >= 0) continue;
      const Vec3 p = f.exit(inside, x);
      if (p.x() > best.x()) best = p;
    }
    return best;
  };
  set_pair(body, "neck", f.exit(f.neck_base, x));
  mark["neck_front"] = f.exit(f.neck_base, f.neck_forward);
  mark["neck_back"] = f.exit(f.neck_base, -f.neck_forward);
  set_pair(body, "shoulder", acromion_of(f));
  // The armpit: the highest free point below the arm, found by climbing between chest and arm.
  Vec3 armpit = side(f.bust_height);
  for (double level = f.bust_height; level < plan.acromion_height; level += 0.002) {
    const Vec3 p = f.exit({0, level, 0.0}, x);
    const Vec3 axis = f.arm_root + f.arm_axis * ((f.arm_root.y() - level) / -f.arm_axis.y());
    if (p.x() > axis.x()) break;
    armpit = p;
  }
  set_pair(body, "armpit", armpit);
  set_pair(body, "bust", f.exit({f.bust_apart, f.bust_height, 0.0}, z));
  mark["under_bust"] = f.exit({0, f.under_bust_height, 0}, z);
  mark["waist"] = f.exit({0, f.waist_height, 0}, z);
  set_pair(body, "waist", side(f.waist_height));
  mark["hip"] = f.exit({0, f.hip_height, 0}, z);
  set_pair(body, "hip", side(f.hip_height));
  const Vec3 biceps = f.arm_root + 0.5 * (f.elbow - f.arm_root);
  set_pair(body, "biceps", biceps);
  set_pair(body, "elbow", f.elbow);
  set_pair(body, "wrist", f.wrist);
  mark["crotch"] = crotch_of(body.mesh, {0, f.hip_height, 0});
  set_pair(body, "knee", f.leg_centre(f.knee_height));
  set_pair(body, "ankle", f.leg_centre(f.ankle_height));
  mark["crown"] = f.exit(f.head_centre(), Vec3::UnitY());
}

/// Everything is read off the mesh, as a customer would with a tape.
void measure(const Figure& f, Mannequin& body) {
  auto& girth = body.girths;
  const TriMesh& mesh = body.mesh;
  const Vec3 y = Vec3::UnitY();
  const auto level = [&](double height) { return widest_tape(mesh, {0, height, 0.01}, y); };
  girth["bust"] = level(f.bust_height);
  girth["under_bust"] = level(f.under_bust_height);
  girth["waist"] = level(f.waist_height);
  girth["hip"] = level(f.hip_height);
  girth["neck_base"] = widest_tape(mesh, f.neck_base, f.neck_forward.cross(Vec3::UnitX()));
  const auto& mark = body.landmarks;
  girth["biceps"] = widest_tape(mesh, mark.at("biceps_right"), f.arm_axis);
  girth["wrist"] = widest_tape(mesh, mark.at("wrist_right"), f.arm_axis);
  const double under_crotch = mark.at("crotch").y() - 0.02;
  girth["thigh"] = widest_tape(mesh, f.leg_centre(under_crotch), y);
  girth["height"] = mark.at("crown").y();
  girth["inside_leg"] = mark.at("crotch").y();
  girth["arm"] = (mark.at("elbow_right") - mark.at("shoulder_right")).norm() +
                 (mark.at("wrist_right") - mark.at("elbow_right")).norm();
}

/// Names the measurement that could not be reached, and the nearest that can, as far as the solver came.
Error impossible(const Measurements& m, const Vec8& miss) {
  const struct {
    const char* name;
    double value;
  } sizes[] = {
      {"under_bust", m.under_bust}, {"bust", m.bust}, {"waist", m.waist}, {"hip", m.hip}, {"neck_base", m.neck_base},
      {"inside_leg", m.inside_leg}, {"arm", m.arm},   {"arm", m.arm}};
  Eigen::Index worst = 0;
  miss.cwiseAbs().maxCoeff(&worst);
  const double asked = sizes[worst].value * 1e3, reached = asked - miss[worst] * 1e3;
  char text[240];
  if (std::isfinite(reached))
    std::snprintf(text, sizeof text,
                  "No body with these other measurements has a %s of %.0f mm: %s %.0f mm works, %s does not.",
                  sizes[worst].name, asked, miss[worst] > 0 ? "up to about" : "from about", reached,
                  miss[worst] > 0 ? "more" : "less");
  else
    std::snprintf(text, sizeof text, "No body has these measurements together.");
  return Error{Cause::unusable, "IMPLAUSIBLE_MEASUREMENTS", text,
               "Check bust, under_bust, waist, hip, inside_leg and neck_base against each other.", ""};
}

}  // namespace
}  // namespace body

Result<Mannequin> build_mannequin(const Measurements& measurements, const MannequinOptions& options) {
  if (Result<bool> checked = body::check_measurements(measurements); !checked) return checked.error();
  if (!(options.surface_spacing >= 0.008 && options.surface_spacing <= 0.03) ||
      !(options.arm_angle_deg >= 35 && options.arm_angle_deg <= 60))
    return Error{Cause::usage, "BAD_OPTION", "The mannequin's surface spacing or arm angle is out of range.",
                 "Give a spacing of 0.008 to 0.03 m and an arm angle of 35 to 60 degrees.", ""};
  const body::BodyPlan plan = body::plan_body(measurements);
  const double angle = options.arm_angle_deg * 0.017453292519943295;
  body::Unknowns unknowns = body::first_guess(measurements);
  // Large bodies take larger triangles, so that their number stays.
  const double skin = measurements.height * (measurements.bust + measurements.waist + measurements.hip);
  const double spacing = options.surface_spacing * std::clamp(std::sqrt(skin / 4.4), 1.0, 1.5);
  Measurements aim = measurements;
  Mannequin result;
  result.source = "built-in " + measurements.sex;
  result.warnings = unusual_measurements(measurements);
  // Triangles cut corners, so the mesh reads a few millimetres off the solid: each round aims that much aside, and the
  // mesh of the first follows the solid.
  body::Vec8 left = body::Vec8::Zero();  ///< what the mesh still misses [m]
  double worst = 0;
  for (int round = 0; round < 5; ++round) {
    const body::Vec8 miss = body::solve(measurements, aim, plan, angle, unknowns);
    if (!(miss.cwiseAbs().maxCoeff() < 3e-3)) return body::impossible(measurements, miss);
    const body::Figure figure(measurements, plan, angle, unknowns);
    const body::Surface surface{[&figure](const Vec3& p) { return figure.distance(p); },
                                [&](const Vec3& p) { return spacing * figure.detail(p); }};
    if (round == 0) {
      result.mesh = body::march(surface.distance, figure.low, figure.high, 0.5 * options.surface_spacing, -0.010);
      body::remesh(result.mesh, surface, 4);
    } else {
      body::settle(result.mesh, surface);
    }
    body::stand(result.mesh, measurements.height);
    body::describe(figure, measurements, plan, result);
    body::measure(figure, result);
    const auto correct = [&](Eigen::Index row, double Measurements::*size, const char* name) {
      left[row] = measurements.*size - result.girths.at(name);
      aim.*size += std::clamp(left[row], -0.01, 0.01);
    };
    correct(0, &Measurements::under_bust, "under_bust");
    correct(1, &Measurements::bust, "bust");
    correct(2, &Measurements::waist, "waist");
    correct(3, &Measurements::hip, "hip");
    correct(4, &Measurements::neck_base, "neck_base");
    correct(5, &Measurements::inside_leg, "inside_leg");
    worst = left.cwiseAbs().maxCoeff();
    if (worst < 4e-4) break;
  }
  if (worst > 5e-3) return body::impossible(measurements, left);
  if (const body::MeshState state = body::inspect(result.mesh); !state.closed() || state.parts != 1)
    return Error{Cause::internal, "BODY_NOT_CLOSED",
                 "The built-in body did not close: " + std::to_string(state.open_edges) + " open, " +
                     std::to_string(state.crowded_edges) + " crowded edges, " + std::to_string(state.parts) + " parts.",
                 "Report the eight measurements; slightly different ones will work.", ""};
  return result;
}

}  // namespace vitrine
