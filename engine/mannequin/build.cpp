// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

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

/// Damped fixed-point rounds on the scalars that the tape answers almost one to one, until the solid built from `m` has
/// the girths in `aim`. Gives the worst error [m].
double solve(const Measurements& m, const Measurements& aim, const BodyPlan& plan, double arm_angle, Unknowns& u) {
  double worst = 0;
  for (int round = 0; round < 14; ++round) {
    const Figure f(m, plan, arm_angle, u);
    const Tapes t = read_tapes(f);
    const double crotch = f.crotch_height();
    const Vec3 acromion = acromion_of(f);
    const double upper = (f.elbow - acromion).norm(), fore = (f.wrist - f.elbow).norm();
    const double miss[] = {
        aim.under_bust - t.under_bust, aim.bust - t.bust,     aim.waist - t.waist,   aim.hip - t.hip,
        aim.neck_base - t.neck,        m.inside_leg - crotch, 0.563 * m.arm - upper, 0.437 * m.arm - fore};
    worst = 0;
    for (double x : miss) worst = std::max(worst, std::abs(x));
    if (worst < 2e-4) break;
    u.under_bust += 0.85 * miss[0];
    u.bust += 0.85 * (miss[1] - miss[0]);
    u.waist += 0.85 * miss[2];
    u.hip += 0.85 * miss[3];
    u.neck += 0.85 * miss[4];
    u.crotch += 0.85 * miss[5];
    u.upper_arm += 0.9 * miss[6];
    u.forearm += 0.9 * miss[7];
  }
  return worst;
}

double widest_tape(const TriMesh& mesh, const Vec3& at, const Vec3& normal) {
  double tape = 0;
  for (const Ring& ring : slice(mesh, at, normal))
    if (ring.holds(at)) tape = std::max(tape, ring.tape);
  return tape;
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
  mark["crotch"] = Vec3(0, m.inside_leg, f.crotch_depth());
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
  Measurements aim = measurements;
  Mannequin result;
  result.source = "built-in " + measurements.sex;
  // Triangles cut corners, so the mesh reads a few millimetres off the solid: the second pass aims that much aside.
  for (int pass = 0; pass < 2; ++pass) {
    if (body::solve(measurements, aim, plan, angle, unknowns) > 3e-3)
      return Error{Cause::unusable, "IMPLAUSIBLE_MEASUREMENTS",
                   "No body was found that has these measurements together.",
                   "Check bust, under_bust, waist, hip, inside_leg and neck_base against each other.", ""};
    const body::Figure figure(measurements, plan, angle, unknowns);
    const body::Surface surface{[&figure](const Vec3& p) { return figure.distance(p); },
                                [&figure](const Vec3& p) { return figure.gradient(p); },
                                [&](const Vec3& p) { return options.surface_spacing * figure.detail(p); }};
    // Marched finer than asked, so that no thumb falls between the grid lines; the remesher takes the surplus out.
    result.mesh =
        body::march(surface.distance, figure.low, figure.high, std::min(0.009, 0.6 * options.surface_spacing));
    body::remesh(result.mesh, surface, 5);
    body::stand(result.mesh, measurements.height);
    if (const body::MeshState state = body::inspect(result.mesh); !state.closed() || state.parts != 1)
      return Error{Cause::internal, "BODY_NOT_CLOSED", "The built-in body did not close.",
                   "Report the eight measurements; slightly different ones will work.", ""};
    body::describe(figure, measurements, plan, result);
    body::measure(figure, result);
    double worst = 0;
    const auto correct = [&](double Measurements::*size, const char* name) {
      const double miss = measurements.*size - result.girths.at(name);
      worst = std::max(worst, std::abs(miss));
      aim.*size += std::clamp(miss, -0.01, 0.01);
    };
    correct(&Measurements::bust, "bust");
    correct(&Measurements::under_bust, "under_bust");
    correct(&Measurements::waist, "waist");
    correct(&Measurements::hip, "hip");
    correct(&Measurements::neck_base, "neck_base");
    if (worst < 1e-3) break;
  }
  return result;
}

}  // namespace vitrine
