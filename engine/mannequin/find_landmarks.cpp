// SPDX-License-Identifier: GPL-3.0-or-later
#include "find_landmarks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "slice.hpp"

namespace vitrine::body {

namespace {

// Heights are shares of the stature; where no shape tells (knee, ankle), they are the ANSUR II means.
constexpr double huge = std::numeric_limits<double>::max();

Error no_body(const std::string& path, const std::string& part) {
  return Error{Cause::unusable, "NOT_A_BODY", "No " + part + " was found on the mannequin " + path + ".",
               "Give a standing body with its arms away from the trunk (25 to 60 degrees) and its legs apart.", ""};
}

std::optional<Ring> ring_around(const TriMesh& mesh, const Vec3& at, const Vec3& normal) {
  for (Ring& ring : slice(mesh, at, normal))
    if (ring.holds(at)) return std::move(ring);
  return std::nullopt;
}

/// The ring whose middle is nearest to `at`, if that is nearer than `reach`.
std::optional<Ring> ring_near(const TriMesh& mesh, const Vec3& at, const Vec3& normal, double reach) {
  std::optional<Ring> best;
  for (Ring& ring : slice(mesh, at, normal)) {
    const double d = (ring.centre - at).norm();
    if (d < reach && ring.area > 1e-4) {
      reach = d;
      best = std::move(ring);
    }
  }
  return best;
}

Vec3 extreme(const Ring& ring, const Vec3& direction) {
  return *std::max_element(ring.points.begin(), ring.points.end(),
                           [&direction](const Vec3& a, const Vec3& b) { return a.dot(direction) < b.dot(direction); });
}

/// Where the ring crosses x = 0, foremost (sign 1) or rearmost (-1).
Vec3 midline(const Ring& ring, int sign) {
  Vec3 best = extreme(ring, sign * Vec3::UnitZ());
  double z = -huge;
  for (std::size_t i = 0; i < ring.points.size(); ++i) {
    const Vec3 &a = ring.points[i], &b = ring.points[(i + 1) % ring.points.size()];
    if ((a.x() < 0) == (b.x() < 0)) continue;
    const Vec3 p = a + a.x() / (a.x() - b.x()) * (b - a);
    if (sign * p.z() > z) {
      z = sign * p.z();
      best = p;
    }
  }
  return best;
}

class Finder {
 public:
  explicit Finder(Mannequin& body) : mesh_(body.mesh), mark_(body.landmarks), girth_(body.girths) {}

  Result<bool> run(const std::string& path) {
    for (const Vec3& v : mesh_.vertices) {
      if (v.y() > h_) {
        h_ = v.y();
        mark_["crown"] = v;
      }
    }
    girth_["height"] = h_;
    if (!centre()) return no_body(path, "trunk");
    if (!legs()) return no_body(path, "pair of legs");
    if (!trunk()) return no_body(path, "pair of arms apart from the trunk");
    if (!neck()) return no_body(path, "neck");
    for (int side : {-1, 1})
      if (!arm(side)) return no_body(path, side < 0 ? "left arm" : "right arm");
    return true;
  }

 private:
  std::optional<Ring> level(double y) const { return ring_around(mesh_, {0, y, depth_}, Vec3::UnitY()); }

  bool centre() {
    // The largest ring at the waist is the trunk, wherever the file's origin is.
    const std::vector<Ring> rings = slice(mesh_, {0, 0.61 * h_, 0}, Vec3::UnitY());
    if (rings.empty()) return false;
    const Vec3 middle = 0.5 * (rings.front().low + rings.front().high);
    for (Vec3& v : mesh_.vertices) v -= Vec3(middle.x(), 0, middle.z());
    mark_["crown"] -= Vec3(middle.x(), 0, middle.z());
    return rings.front().area > 0.005 * h_ * h_;
  }

  bool legs() {
    // From the hips down to the first level at which nothing spans the middle.
    double crotch = 0;
    Ring above;
    for (double y = 0.58 * h_; y > 0.25 * h_; y -= 0.0015 * h_) {
      const std::vector<Ring> rings = slice(mesh_, {0, y, 0}, Vec3::UnitY());
      const auto spans =
          std::find_if(rings.begin(), rings.end(), [](const Ring& r) { return r.low.x() < 0 && r.high.x() > 0; });
      if (spans == rings.end()) {
        crotch = y + 0.00075 * h_;
        break;
      }
      above = *spans;
    }
    if (crotch == 0 || above.points.empty()) return false;
    mark_["crotch"] = Vec3(0, crotch, above.centre.z());
    girth_["inside_leg"] = crotch;
    const double below = crotch - 0.02;
    double thigh = 0;
    for (int side : {-1, 1}) {
      const std::string name = side < 0 ? "_left" : "_right";
      const auto leg = [&](double y) {
        std::optional<Ring> best;
        for (Ring& ring : slice(mesh_, {0, y, 0}, Vec3::UnitY()))
          if (ring.centre.x() * side > 0 && std::abs(ring.centre.x()) < 0.16 * h_ && (!best || ring.area > best->area))
            best = std::move(ring);
        return best;
      };
      const auto top = leg(below), knee = leg(0.574 * crotch), ankle = leg(0.040 * h_);
      if (!top || !knee || !ankle) return false;
      thigh += 0.5 * top->tape;
      mark_["thigh" + name] = top->centre;
      mark_["knee" + name] = knee->centre;
      mark_["ankle" + name] = ankle->centre;
    }
    girth_["thigh"] = thigh;
    return true;
  }

  void sides(const std::string& name, const Ring& ring) {
    mark_[name + "_left"] = extreme(ring, -Vec3::UnitX());
    mark_[name + "_right"] = extreme(ring, Vec3::UnitX());
  }

  bool trunk() {
    const double crotch = girth_["inside_leg"];
    double widest = 0, narrowest = huge;
    Ring hip, waist;
    for (double y = crotch + 0.006 * h_; y <= std::max(0.56, crotch / h_ + 0.03) * h_; y += 0.004 * h_)
      if (auto ring = level(y); ring && ring->tape > widest) {
        widest = ring->tape;
        hip = *ring;
      }
    for (double y = 0.60 * h_; y <= 0.6601 * h_; y += 0.004 * h_)
      if (auto ring = level(y); ring && ring->tape < narrowest) {
        narrowest = ring->tape;
        waist = *ring;
      }
    if (hip.points.empty() || waist.points.empty()) return false;
    mark_["hip"] = midline(hip, 1);
    mark_["waist"] = midline(waist, 1);
    sides("hip", hip);
    sides("waist", waist);
    girth_["hip"] = hip.tape;
    girth_["waist"] = waist.tape;
    // Upwards from there the section suddenly takes in the arms: the armpits are just below.
    std::optional<Ring> last = level(0.66 * h_);
    bool found = false;
    for (double y = 0.6625 * h_; last && y < 0.84 * h_; y += 0.0025 * h_) {
      std::optional<Ring> ring = level(y);
      if (!ring) return false;
      if (ring->high.x() - ring->low.x() > last->high.x() - last->low.x() + 0.045 * h_) {
        found = true;
        break;
      }
      last = std::move(ring);
    }
    if (!found) return false;
    sides("armpit", *last);
    const double armpit = last->centre.y();
    // The bust is where the chest reaches furthest forward; a belly further down does not count.
    double foremost = -huge;
    Ring bust;
    for (double y = std::min(0.69 * h_, armpit - 0.03 * h_); y <= std::min(0.76 * h_, armpit - 0.004 * h_);
         y += 0.003 * h_)
      if (auto ring = level(y); ring && ring->high.z() > foremost) {
        foremost = ring->high.z();
        bust = *ring;
      }
    if (bust.points.empty()) return false;
    for (int side : {-1, 1}) {
      Vec3 best(0, bust.centre.y(), -huge);
      for (const Vec3& p : bust.points)
        if (p.x() * side > 0.01 * h_ && p.z() > best.z()) best = p;
      mark_[side < 0 ? "bust_left" : "bust_right"] = best;
    }
    girth_["bust"] = bust.tape;
    const auto under = level(bust_fold(mark_["bust_right"]));
    if (!under) return false;
    mark_["under_bust"] = midline(*under, 1);
    girth_["under_bust"] = under->tape;
    return true;
  }

  /// Level of the fold under the breast: where the outline in front, after falling back from the bust point, turns to
  /// follow the ribs. A flat chest has none; its under-bust is at the lower edge of the chest muscle.
  double bust_fold(const Vec3& bust) const {
    const std::vector<Ring> rings = slice(mesh_, {bust.x(), 0, 0}, Vec3::UnitX());
    const auto front = [&](double y) {
      double z = -huge;
      for (const Ring& ring : rings)
        for (std::size_t i = 0; i < ring.points.size(); ++i) {
          const Vec3 &a = ring.points[i], &b = ring.points[(i + 1) % ring.points.size()];
          if ((a.y() < y) == (b.y() < y)) continue;
          z = std::max(z, a.z() + (y - a.y()) / (b.y() - a.y()) * (b.z() - a.z()));
        }
      return z;
    };
    const double step = 0.004 * h_;
    double sharpest = 0, fold = bust.y() - 0.015 * h_;
    for (double y = bust.y() - 0.012 * h_; y > bust.y() - 0.055 * h_; y -= 0.001 * h_) {
      const double turn = front(y + step) - 2 * front(y) + front(y - step);
      if (turn > sharpest && bust.z() - front(y) > 0.008 * h_) {
        sharpest = turn;
        fold = y;
      }
    }
    return fold;
  }

  bool neck() {
    // The narrowest level above the shoulders, then down to where the silhouette leaves the neck at 45 degrees.
    double narrow = huge, y0 = 0;
    const auto neck_ring = [&](double y) {
      std::optional<Ring> best;
      for (Ring& ring : slice(mesh_, {0, y, 0}, Vec3::UnitY()))
        if (ring.low.x() < 0 && ring.high.x() > 0 && (!best || ring.area > best->area)) best = std::move(ring);
      return best;
    };
    for (double y = 0.835 * h_; y < 0.91 * h_; y += 0.003 * h_)
      if (auto ring = neck_ring(y); ring && ring->high.x() - ring->low.x() < narrow) {
        narrow = ring->high.x() - ring->low.x();
        y0 = y;
      }
    const double step = 0.004 * h_;
    double side_y = 0, before = 0;
    std::optional<Ring> last = neck_ring(y0);
    for (double y = y0 - step; last && y > 0.78 * h_; y -= step) {
      std::optional<Ring> ring = neck_ring(y);
      if (!ring) return false;
      // Both sides together widen by twice the way down where they stand at 45 degrees.
      const double slope = (ring->high.x() - ring->low.x() - (last->high.x() - last->low.x())) / step;
      if (slope > 2) {
        side_y = y + (0.5 + (slope - 2) / std::max(slope - before, 1e-9)) * step;
        break;
      }
      before = slope;
      last = std::move(ring);
    }
    if (side_y == 0) return false;
    sides("neck", *last);
    // C7 lies at 0.8605 of the height (ANSUR II, women and men), a little above the side of the neck; the pit of the
    // throat lies lower.
    const auto back = neck_ring(std::clamp(0.8605 * h_, side_y + 0.001 * h_, side_y + 0.012 * h_)),
               front = neck_ring(side_y - 0.026 * h_);
    if (!back || !front) return false;
    const Vec3 c7 = midline(*back, -1), pit = midline(*front, 1);
    mark_["neck_back"] = c7;
    mark_["neck_front"] = pit;
    const Vec3 normal = Vec3(0, pit.z() - c7.z(), c7.y() - pit.y()).normalized();
    const auto base = ring_around(mesh_, 0.5 * (c7 + pit), normal);
    if (!base) return false;
    girth_["neck_base"] = base->tape;
    return true;
  }

  bool arm(int side) {
    const std::string name = side < 0 ? "_left" : "_right";
    const Vec3 armpit = mark_["armpit" + name];
    // The acromion is the top of the shoulder above the armpit.
    Vec3 acromion(0, -huge, 0);
    for (const Ring& ring : slice(mesh_, {1.02 * armpit.x(), 0, 0}, Vec3::UnitX())) {
      const Vec3 top = extreme(ring, Vec3::UnitY());
      if (top.y() > acromion.y()) acromion = top;
    }
    Vec3 tip = armpit;
    for (const Vec3& v : mesh_.vertices)
      if (v.x() * side > tip.x() * side && v.y() > 0.3 * h_) tip = v;
    const Vec3 root(armpit.x(), 0.5 * (armpit.y() + acromion.y()), acromion.z());
    const double reach = (tip - acromion).norm();
    if (acromion.y() < armpit.y() || reach < 0.30 * h_ || reach > 0.60 * h_) return false;
    const Vec3 axis = (tip - root).normalized();
    const double length = (tip - root).dot(axis);
    // Follow the middle of the arm outwards.
    std::vector<Vec3> centre;
    std::vector<double> tape;
    std::vector<double> at;
    for (double t = 0.20; t < 0.93; t += 0.01) {
      const Vec3 guess = centre.empty() ? Vec3(root + t * length * axis) : Vec3(centre.back() + 0.01 * length * axis);
      const auto ring = ring_near(mesh_, guess, axis, 0.05 * h_);
      if (!ring) continue;
      centre.push_back(ring->centre);
      tape.push_back(ring->tape);
      at.push_back(t);
    }
    if (centre.size() < 50) return false;
    // Wrist: the narrowest place about three quarters of the way to the finger tips (ANSUR II: 0.753).
    std::size_t wrist = 0;
    for (std::size_t i = 0; i < at.size(); ++i)
      if (at[i] >= 0.66 && at[i] <= 0.80 && (wrist == 0 || tape[i] < tape[wrist])) wrist = i;
    girth_["wrist"] += 0.5 * tape[wrist];
    // The wrist bones end a little further out, where the tape begins to widen towards the hand.
    const double narrowest = tape[wrist];
    while (wrist + 1 < tape.size() && at[wrist] < 0.86 && tape[wrist] < 1.10 * narrowest) ++wrist;
    // Elbow: 0.563 of the way from acromion to wrist (ANSUR II).
    std::size_t elbow = 0;
    const double whole = (centre[wrist] - acromion).norm();
    for (std::size_t i = 0; i < wrist; ++i)
      if ((centre[i] - acromion).norm() <= 0.563 * whole) elbow = i;
    std::size_t biceps = 0;
    for (std::size_t i = 0; i < elbow; ++i)
      if ((centre[i] - acromion).norm() <= 0.5 * (centre[elbow] - acromion).norm()) biceps = i;
    if (wrist == 0 || elbow == 0) return false;
    mark_["shoulder" + name] = acromion;
    mark_["biceps" + name] = centre[biceps];
    mark_["elbow" + name] = centre[elbow];
    mark_["wrist" + name] = centre[wrist];
    girth_["biceps"] += 0.5 * tape[biceps];
    girth_["arm"] += 0.5 * ((centre[elbow] - acromion).norm() + (centre[wrist] - centre[elbow]).norm());
    return true;
  }

  TriMesh& mesh_;
  std::map<std::string, Vec3>& mark_;
  std::map<std::string, double>& girth_;
  double h_ = 0, depth_ = 0;
};

}  // namespace

Result<bool> find_landmarks(Mannequin& body, const std::string& path) {
  return Finder(body).run(path);
}

}  // namespace vitrine::body
