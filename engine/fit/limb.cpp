// SPDX-License-Identifier: GPL-3.0-or-later
#include "limb.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vitrine {
namespace {

/// The outline between two corners, both included, on the side that does not pass `avoid`.
std::vector<Vec2> along_outline(const Panel& panel, int from, int to, int avoid) {
  const int n = static_cast<int>(panel.outline.size());
  for (const int step : {1, n - 1}) {
    std::vector<Vec2> line{panel.outline[from]};
    bool clear = true;
    for (int i = from; i != to && clear;) {
      i = (i + step) % n;
      clear = i != avoid;
      line.push_back(panel.outline[i]);
    }
    if (clear) return line;
  }
  return {};
}

/// `count` + 1 points over the last `length` [m] of the line, at equal steps.
std::vector<Vec2> last_stretch(const std::vector<Vec2>& line, double length, int count) {
  std::vector<double> arc{0};
  for (std::size_t i = 1; i < line.size(); ++i) arc.push_back(arc.back() + (line[i] - line[i - 1]).norm());
  std::vector<Vec2> even;
  std::size_t k = 1;
  for (int i = 0; i <= count; ++i) {
    const double s = arc.back() - length * (count - i) / count;
    while (k + 1 < line.size() && arc[k] < s) ++k;
    const double piece = std::max(1e-12, arc[k] - arc[k - 1]);
    even.push_back(line[k - 1] + (line[k] - line[k - 1]) * std::clamp((s - arc[k - 1]) / piece, 0.0, 1.0));
  }
  return even;
}

double length_of(const std::vector<Vec2>& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += (line[i] - line[i - 1]).norm();
  return sum;
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  const double t = std::clamp((p - a).dot(d) / std::max(1e-18, d.squaredNorm()), 0.0, 1.0);
  return (p - a - t * d).norm();
}

/// Inside the polygon or on its border (the panel's own outline nodes lie exactly on it).
bool belongs(const Vec2& p, const std::vector<Vec2>& polygon) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 &a = polygon[i], &b = polygon[j];
    if (distance_to_segment(p, a, b) < 1e-7) return true;
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
      inside = !inside;
  }
  return inside;
}

constexpr int limb_steps = 10;
constexpr double apart = 0.004;  // [m] of a limb's cloth from the plane between left and right

/// Whether the body ends all around this place on a limb's middle line within twice the limb's radius: further up the
/// limb runs into the trunk.
bool is_free(const DistanceField& field, const Vec3& centre, double radius, const Vec3& along) {
  const Vec3 u = along.unitOrthogonal(), v = along.cross(u);
  for (int k = 0; k < 16; ++k) {
    const Vec3 way = std::cos(k * M_PI / 8) * u + std::sin(k * M_PI / 8) * v;
    bool ends = false;
    for (double r = radius; r < 2 * radius && !ends; r += 0.002) ends = field.distance(centre + r * way) > 0;
    if (!ends) return false;
  }
  return true;
}

Vec2 left_of(const Vec2& t) {
  return {-t.y(), t.x()};
}

}  // namespace

Polyline::Polyline(std::vector<Vec2> points) : points_(std::move(points)) {
  arc_.push_back(0);
  for (std::size_t i = 1; i < points_.size(); ++i) arc_.push_back(arc_.back() + (points_[i] - points_[i - 1]).norm());
}

Vec2 Polyline::at(double s, Vec2& tangent) const {
  std::size_t k = 1;
  while (k + 1 < points_.size() && arc_[k] < s) ++k;
  const double piece = std::max(1e-12, arc_[k] - arc_[k - 1]);
  tangent = (points_[k] - points_[k - 1]) / piece;
  return points_[k - 1] + tangent * (s - arc_[k - 1]);
}

void Polyline::project(const Vec2& p, double& s, double& offset) const {
  double best = std::numeric_limits<double>::max();
  for (std::size_t k = 1; k < points_.size(); ++k) {
    const double piece = std::max(1e-12, arc_[k] - arc_[k - 1]);
    const Vec2 t = (points_[k] - points_[k - 1]) / piece;
    double along = (p - points_[k - 1]).dot(t);
    if (k > 1) along = std::max(along, 0.0);
    if (k + 1 < points_.size()) along = std::min(along, piece);
    const double d = (p - points_[k - 1] - along * t).squaredNorm();
    if (d < best) {
      best = d;
      s = arc_[k - 1] + along;
      offset = (p - points_[k - 1]).dot(left_of(t));
    }
  }
}

Result<LimbBend> LimbBend::make(const TemplateLimb& limb, const Panel& panel, const Mannequin& mannequin,
                                const DistanceField& field, const Vec2& shift, double clearance) {
  std::vector<Vec3> chain;
  for (const std::string& name : limb.chain) {
    const auto found = mannequin.landmarks.find(name);
    if (found == mannequin.landmarks.end())
      return Error{Cause::unusable, "NO_LANDMARK",
                   "the mannequin has no landmark \"" + name + "\" that limb \"" + limb.name + "\" follows",
                   "use another mannequin, or correct the limb's chain in the garment plugin", "fit"};
    chain.push_back(found->second);
  }
  const int root_a = panel.corner[limb.root_a], root_b = panel.corner[limb.root_b];
  const int tip_a = panel.corner[limb.tip_a], tip_b = panel.corner[limb.tip_b];
  const auto side_a = along_outline(panel, root_a, tip_a, root_b);
  const auto side_b = along_outline(panel, root_b, tip_b, root_a);
  if (chain.size() < 2 || side_a.empty() || side_b.empty())
    return Error{Cause::plugin, "BAD_LIMB", "limb \"" + limb.name + "\" does not run along the panel's outline",
                 "correct the limb's root and tip features in the garment plugin", "fit"};

  LimbBend bend;
  bend.clearance_ = clearance;
  // The sides are paired by their distance from the tip: a sleeve's upper side is longer by its cap, which belongs to
  // the shoulder. The middle line runs on straight where only one side is left.
  const double paired = std::min(length_of(side_a), length_of(side_b));
  const auto even_a = last_stretch(side_a, paired, limb_steps), even_b = last_stretch(side_b, paired, limb_steps);
  std::vector<Vec2> middle;
  for (int i = 0; i <= limb_steps; ++i) {
    middle.push_back((even_a[i] + even_b[i]) / 2 + shift);
    bend.half_width_.push_back(std::max(0.01, (even_a[i] - even_b[i]).norm() / 2));
  }
  bend.flat_ = Polyline(middle);
  for (const Vec2& q : side_a) bend.region_.push_back(q + shift);
  const auto tip = along_outline(panel, tip_a, tip_b, root_b);
  for (std::size_t i = 1; i + 1 < tip.size(); ++i) bend.region_.push_back(tip[i] + shift);
  for (std::size_t i = side_b.size(); i-- > 0;) bend.region_.push_back(side_b[i] + shift);
  bend.root_a_ = bend.region_.front();
  bend.root_b_ = bend.region_.back();
  bend.blend_ = std::clamp(0.5 * (bend.root_a_ - bend.root_b_).norm(), 0.02, 0.12);
  bend.find_rings(field, chain);
  double ignored = 0;
  bend.body_.project(middle.front(), bend.body_start_, ignored);
  bend.body_start_ = std::max(0.0, bend.body_start_);
  return bend;
}

/// Landmarks lie on the skin or on a joint; the limb's true middle is where the field is deepest across it. Near the
/// root, where the limb runs into the trunk, the middle is carried on from the free part.
void LimbBend::find_rings(const DistanceField& field, const std::vector<Vec3>& chain) {
  std::vector<double> arc{0};
  for (std::size_t i = 1; i < chain.size(); ++i) arc.push_back(arc.back() + (chain[i] - chain[i - 1]).norm());
  std::vector<Vec3> offset;
  for (int i = 0; i <= limb_steps; ++i) {
    const double s = arc.back() * i / limb_steps;
    std::size_t k = 1;
    while (k + 1 < chain.size() && arc[k] < s) ++k;
    const Vec3 along = (chain[k] - chain[k - 1]) / std::max(1e-12, arc[k] - arc[k - 1]);
    const Vec3 start = chain[k - 1] + along * (s - arc[k - 1]);
    Vec3 centre = start;
    double length = 0.005;  // shrinking steps, 60 mm in all, end within a fraction of a millimetre
    for (int step = 0; step < 40; ++step, length *= 0.92) {
      Vec3 gradient;
      field.distance(centre, gradient);
      Vec3 inwards = -gradient + along * along.dot(gradient);
      if (inwards.norm() < 0.1) break;
      centre += inwards.normalized() * length;
      if ((centre - start).norm() > 0.05) break;  // no limb is thicker than that off its own landmarks: it is the trunk
    }
    rings_.push_back({centre, std::max(0.0, -field.distance(centre))});
    offset.push_back(centre - start);
  }
  // A chain that begins beyond the trunk (a thigh) has nothing to carry on from.
  int free_from = limb_steps * 2 / 5;
  for (const int i : {1, 0})
    if (is_free(field, rings_[i].centre, rings_[i].radius, (chain[1] - chain[0]).normalized())) free_from = i;
  for (int i = 0; i < free_from; ++i) {
    rings_[i].centre += offset[free_from] - offset[i];
    rings_[i].radius = rings_[free_from].radius;
  }
  std::vector<Vec2> line;
  for (const Ring& ring : rings_) line.push_back(ring.centre.head<2>());
  body_ = Polyline(line);
}

double LimbBend::weight(const Vec2& placed) const {
  if (!belongs(placed, region_)) return 0;
  const double t = std::clamp(distance_to_segment(placed, root_a_, root_b_) / blend_, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Vec3 LimbBend::on_limb(const Vec2& placed, double outwards, const Gaps& gaps) const {
  double s = 0, offset = 0;
  flat_.project(placed, s, offset);
  const double step = std::clamp(s / flat_.length(), 0.0, 1.0) * limb_steps;
  const int i = std::min(limb_steps - 1, static_cast<int>(step));
  const double half = half_width_[i] + (half_width_[i + 1] - half_width_[i]) * (step - i);

  // A sleeve longer than the arm is pushed up to the wrist, as a wearer would: it closes there and not around the hand.
  const double room = body_.length() + 0.02 - body_start_;
  const double on_body = body_start_ + (s > 0 ? s * std::min(1.0, room / flat_.length()) : s);
  Vec2 tangent;
  const Vec2 middle = body_.at(on_body, tangent);
  const double ring = std::clamp(on_body / body_.length(), 0.0, 1.0) * limb_steps;
  const int r = std::min(limb_steps - 1, static_cast<int>(ring));
  const double a = ring - r;
  const double z = rings_[r].centre.z() + a * (rings_[r + 1].centre.z() - rings_[r].centre.z());
  const double thick = rings_[r].radius + a * (rings_[r + 1].radius - rings_[r].radius);

  // Half the tube's girth is the panel's width; a limb too thick for it stretches the tube.
  const double radius = std::max(2 * half / M_PI, 1.15 * thick + clearance_);
  const double angle = std::clamp(offset / half, -1.0, 1.0) * M_PI / 2;
  Vec2 xy = middle + radius * std::sin(angle) * left_of(tangent);
  // Neither through the other leg's half nor, for a limb that hangs inside the arms, around the arms.
  const int side = middle.x() < 0 ? -1 : 1;
  xy.x() = side * std::max(apart, side * xy.x());
  const double gap = gaps.middle(xy.y(), side);
  if (side * middle.x() < gap) xy.x() = side * std::min(gap, side * xy.x());
  return {xy.x(), xy.y(), z + outwards * radius * std::cos(angle)};
}

}  // namespace vitrine
