// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

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

/// The level between the hips' ends where `girth` is largest, and that girth. Hips are measured where they are fullest:
/// on some people at the buttocks, on some just above the crotch.
struct Fullest {
  double level = 0, girth = 0;
};
template <typename Girth>
Fullest fullest_hips(const Figure& f, int levels, const Girth& girth) {
  Fullest best;
  for (int i = 0; i < levels; ++i) {
    const double level = f.hips_low + (f.hips_high - f.hips_low) * i / (levels - 1);
    if (const double found = girth(level); found > best.girth) best = {level, found};
  }
  return best;
}

Tapes read_tapes(const Figure& f) {
  const auto level = [&f](double y) { return f.tape({0, y, 0.01}, Vec3::UnitX(), Vec3::UnitZ()); };
  const auto hips = [&f](double y) { return f.tape({0, y, 0.01}, Vec3::UnitX(), Vec3::UnitZ(), f.hip_reach()); };
  return {level(f.under_bust_height), level(f.bust_height), level(f.waist_height), fullest_hips(f, 5, hips).girth,
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

constexpr double surface_spacing = 0.0205;               ///< [m] triangle edge on the trunk; hands, feet, head: finer
constexpr double arm_angle = 42 * 0.017453292519943295;  ///< [rad] from the vertical; more where a wide chest needs it
constexpr double under_crotch = 0.02;                    ///< [m] where the thigh is measured

using Vec8 = Eigen::Matrix<double, 8, 1>;  ///< in the order of `sizes`

/// What the solver reaches for, in its order.
struct Size {
  const char* name;
  double Measurements::*value;
};
constexpr Size sizes[] = {{"under_bust", &Measurements::under_bust},
                          {"bust", &Measurements::bust},
                          {"waist", &Measurements::waist},
                          {"hip", &Measurements::hip},
                          {"neck_base", &Measurements::neck_base},
                          {"inside_leg", &Measurements::inside_leg},
                          {"arm", &Measurements::arm},
                          {"arm", &Measurements::arm}};
constexpr int girths_and_leg = 6;  ///< the sizes that are corrected on the mesh

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
Vec8 solve(const Measurements& m, const Measurements& aim, const BodyPlan& plan, Unknowns& u) {
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

/// Where the ray from an inside point first leaves the mesh; `from` itself if it never does.
Vec3 skin(const TriMesh& mesh, const Vec3& from, const Vec3& direction) {
  double first = 1e9;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[t[0]], ab = mesh.vertices[t[1]] - a, ac = mesh.vertices[t[2]] - a;
    const Vec3 across = direction.cross(ac);
    const double turn = ab.dot(across);
    if (!(turn < -1e-16)) continue;  // seen from inside, an outward triangle turns the other way
    const double u = (from - a).dot(across) / turn;
    const Vec3 around = (from - a).cross(ab);
    const double v = direction.dot(around) / turn, way = ac.dot(around) / turn;
    if (u >= -1e-9 && v >= -1e-9 && u + v <= 1 + 1e-9 && way > 0) first = std::min(first, way);
  }
  return first < 1e9 ? Vec3(from + first * direction) : from;
}

void set_pair(Mannequin& body, const std::string& name, const Vec3& right) {
  body.landmarks[name + "_right"] = right;
  body.landmarks[name + "_left"] = Vec3(-right.x(), right.y(), right.z());
}

void describe(const Figure& f, const BodyPlan& plan, Mannequin& body) {
  auto& mark = body.landmarks;
  const Vec3 x = Vec3::UnitX(), z = Vec3::UnitZ();
  const auto out = [&body](const Vec3& from, const Vec3& way) { return skin(body.mesh, from, way); };
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
  set_pair(body, "neck", out(f.neck_base, x));
  mark["neck_front"] = out(f.neck_base, f.neck_forward);
  mark["neck_back"] = out(f.neck_base, -f.neck_forward);
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
  set_pair(body, "bust", out({f.bust_apart, f.bust_height, 0.0}, z));
  mark["under_bust"] = out({0, f.under_bust_height, 0}, z);
  mark["waist"] = out({0, f.waist_height, 0}, z);
  set_pair(body, "waist", side(f.waist_height));
  const double hips = fullest_hips(f, 12, [&body](double y) {
                        return widest_tape(body.mesh, {0, y, 0.01}, Vec3::UnitY());
                      }).level;
  mark["hip"] = out({0, hips, 0}, z);
  set_pair(body, "hip", side(hips));
  const Vec3 biceps = f.arm_root + 0.5 * (f.elbow - f.arm_root);
  set_pair(body, "biceps", biceps);
  set_pair(body, "elbow", f.elbow);
  set_pair(body, "wrist", f.wrist);
  mark["crotch"] = crotch_of(body.mesh, {0, f.hip_height, 0});
  set_pair(body, "thigh", f.leg_centre(mark["crotch"].y() - under_crotch));
  set_pair(body, "knee", f.leg_centre(f.knee_height));
  set_pair(body, "ankle", f.leg_centre(f.ankle_height));
  const Vec3 top = *std::max_element(body.mesh.vertices.begin(), body.mesh.vertices.end(),
                                     [](const Vec3& a, const Vec3& b) { return a.y() < b.y(); });
  mark["crown"] = Vec3(0, top.y(), top.z());
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
  girth["hip"] = level(body.landmarks.at("hip").y());
  girth["neck_base"] = widest_tape(mesh, f.neck_base, f.neck_forward.cross(Vec3::UnitX()));
  const auto& mark = body.landmarks;
  girth["biceps"] = widest_tape(mesh, mark.at("biceps_right"), f.arm_axis);
  girth["wrist"] = widest_tape(mesh, mark.at("wrist_right"), f.arm_axis);
  girth["thigh"] = widest_tape(mesh, f.leg_centre(mark.at("crotch").y() - under_crotch), y);
  girth["height"] = mark.at("crown").y();
  girth["inside_leg"] = mark.at("crotch").y();
  girth["arm"] = (mark.at("elbow_right") - mark.at("shoulder_right")).norm() +
                 (mark.at("wrist_right") - mark.at("elbow_right")).norm();
}

constexpr double solver_bar = 3e-3;  ///< [m] what the solid may miss
constexpr double mesh_bar = 5e-3;    ///< [m] what the mesh may miss before the body is refused
constexpr std::size_t fewest_triangles = 10'500, most_triangles = 19'500;
constexpr double usual_triangles = 16'000;
constexpr double least_angle = 0.21;  ///< [rad] 12 degrees: thinner triangles are meshed again

/// A body, or how far the solver came.
struct Attempt {
  Mannequin body;
  Vec8 missed = Vec8::Zero();  ///< [m] by the mesh or, where `solved` is false, by the solid
  bool solved = false;
  bool good() const { return solved && missed.cwiseAbs().maxCoeff() <= mesh_bar; }
};

Attempt attempt(const Measurements& m) {
  const BodyPlan plan = plan_body(m);
  Unknowns unknowns = first_guess(m);
  // Large bodies take larger triangles, so that their number stays.
  const double skin = m.height * (m.bust + m.waist + m.hip);
  double spacing = surface_spacing * std::clamp(std::sqrt(skin / 4.4), 0.9, 1.5);
  Measurements aim = m;
  Vec8 step = Vec8::Zero();  ///< [m] by which the last round moved the aim
  Attempt result, best;
  TriMesh& mesh = result.body.mesh;
  // Triangles cut corners, so the mesh reads a few millimetres off the solid: each round aims that much aside, and the
  // mesh of the first follows the solid.
  for (int round = 0; round < 10; ++round) {
    const Vec8 miss = solve(m, aim, plan, unknowns);
    if (!(miss.cwiseAbs().maxCoeff() < solver_bar)) {
      if (best.solved) break;
      return {{}, miss, false};
    }
    const Figure figure(m, plan, arm_angle, unknowns);
    const Surface surface{[&figure](const Vec3& p) { return figure.distance(p); },
                          [&](const Vec3& p) { return spacing * figure.detail(p); }};
    if (round == 0) {
      mesh = march(surface.distance, figure.low, figure.high, 0.5 * surface_spacing, -0.010);
      remesh(mesh, surface, 4);
      for (int i = 0; i < 3 && (mesh.triangles.size() < fewest_triangles || mesh.triangles.size() > most_triangles);
           ++i) {
        spacing *= std::sqrt(static_cast<double>(mesh.triangles.size()) / usual_triangles);
        remesh(mesh, surface, 2);
      }
    } else {
      settle(mesh, surface);
      if (smallest_angle(mesh) < least_angle) remesh(mesh, surface, 2);
    }
    // The aim may drift to a solid that falls apart; the rounds before it stand.
    if (mesh.triangles.empty() || mesh.triangles.size() > 2 * most_triangles) break;
    stand(mesh, m.height);
    describe(figure, plan, result.body);
    measure(figure, result.body);
    const Vec8 before = result.missed;
    for (int i = 0; i < girths_and_leg; ++i) {
      result.missed[i] = m.*sizes[i].value - result.body.girths.at(sizes[i].name);
      // Secant steps: where hips are fullest may move, and then the mesh answers twice what the solid was asked.
      const double answer = std::abs(step[i]) > 2e-4 ? (before[i] - result.missed[i]) / step[i] : 1.0;
      step[i] = std::clamp(result.missed[i] / std::clamp(answer, 0.5, 3.0), -0.01, 0.01) * (round < 3 ? 1.0 : 0.6);
      // A size that does not follow would be led until the solid falls apart.
      double& aimed = aim.*sizes[i].value;
      step[i] = std::clamp(aimed + step[i], m.*sizes[i].value - 0.02, m.*sizes[i].value + 0.02) - aimed;
      aimed += step[i];
    }
    const double worst = result.missed.cwiseAbs().maxCoeff();
    if (!best.solved || worst < best.missed.cwiseAbs().maxCoeff()) {
      best = result;
      best.solved = true;
    }
    // Most bodies are there in two or three rounds; the rest may do with a little less.
    if (worst < (round < 4 ? 4e-4 : 1e-3)) break;
  }
  return best;
}

/// Values of one measurement with which the others make a body [m].
struct Range {
  double low = 0, high = 0;
};

/// The values of `size` nearest to the one in `m` that make a body: looked for on the solid, both ends tried on the
/// mesh.
std::optional<Range> range_that_works(Measurements m, double Measurements::*size) {
  const double asked = m.*size;
  const auto works = [&](double value) {
    m.*size = value;
    if (!check_measurements(m)) return false;
    Unknowns unknowns = first_guess(m);
    const Vec8 miss = solve(m, m, plan_body(m), unknowns);
    return miss.cwiseAbs().maxCoeff() < solver_bar;
  };
  constexpr double step = 0.02;
  double near = 0, way = 0;
  for (int i = 1; i <= 25 && way == 0; ++i)
    for (const double side : {1.0, -1.0})
      if (way == 0 && works(asked + side * i * step)) {
        near = asked + side * i * step;
        way = side;
      }
  if (way == 0) return std::nullopt;
  double far = near;
  while (std::abs(far - asked) < 0.6 && works(far + way * step)) far += way * step;
  // The ends lie within a step of the values that failed: found to the millimetre, and safe by one.
  const auto refine = [&](double good, double bad) {
    while (std::abs(good - bad) > 1e-3) (works(0.5 * (good + bad)) ? good : bad) = 0.5 * (good + bad);
    return good;
  };
  const double inner = refine(near, near - way * step) + way * 1e-3, outer = refine(far, far + way * step) - way * 1e-3;
  const auto whole = [&](double value) {
    m.*size = value;
    return attempt(m).good();
  };
  // What the mesh makes of an end may differ: then the range shrinks towards what is known to work.
  double ends[2] = {inner, outer};
  for (double& end : ends)
    for (int i = 0; i < 4 && !whole(end); ++i) end += 0.5 * ((&end == ends ? outer : inner) - end);
  for (const double end : ends)
    if (!whole(end)) return std::nullopt;
  return Range{std::min(ends[0], ends[1]), std::max(ends[0], ends[1])};
}

/// Names the measurement to change, the one that is missed most first, and the range that works.
Error impossible(const Measurements& m, const Vec8& miss) {
  std::array<int, 7> order{0, 1, 2, 3, 4, 5, 6};
  const auto badly = [&miss](int i) { return std::isfinite(miss[i]) ? std::abs(miss[i]) : 1e9; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return badly(a) > badly(b); });
  for (const int i : order) {
    const std::optional<Range> range = range_that_works(m, sizes[i].value);
    if (!range) continue;
    // Whole millimetres; a range without any is no advice.
    const double low = std::ceil(range->low * 1e3), high = std::floor(range->high * 1e3);
    if (low > high) continue;
    char text[240];
    std::snprintf(text, sizeof text, "%s of %.0f mm fits no body with these other measurements: %.0f to %.0f mm works.",
                  sizes[i].name, m.*sizes[i].value * 1e3, low, high);
    return Error{Cause::unusable, "IMPLAUSIBLE_MEASUREMENTS", text,
                 std::string("Give ") + sizes[i].name + " within that range, or check the other measurements.", ""};
  }
  return Error{Cause::unusable, "IMPLAUSIBLE_MEASUREMENTS",
               "No body has these measurements, and changing a single one does not help.",
               "Start from a preset of that size (woman-m, man-l, ...) and change what is known.", ""};
}

}  // namespace
}  // namespace body

Result<Mannequin> build_mannequin(const Measurements& measurements) {
  if (Result<bool> checked = body::check_measurements(measurements); !checked) return checked.error();
  body::Attempt made = body::attempt(measurements);
  if (!made.good()) return body::impossible(measurements, made.missed);
  Mannequin& result = made.body;
  result.source = "built-in " + measurements.sex;
  result.warnings = unusual_measurements(measurements);
  if (const body::MeshState state = body::inspect(result.mesh); !state.closed() || state.parts != 1)
    return Error{Cause::internal, "BODY_NOT_CLOSED",
                 "The built-in body did not close: " + std::to_string(state.open_edges) + " open, " +
                     std::to_string(state.crowded_edges) + " crowded edges, " + std::to_string(state.parts) + " parts.",
                 "Report the eight measurements; slightly different ones will work.", ""};
  return std::move(result);
}

}  // namespace vitrine
