// SPDX-License-Identifier: GPL-3.0-or-later
#include "evidence.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "legs.hpp"

namespace vitrine::features_detail {
namespace {

constexpr double kOutOfReach = 1e18;
constexpr double kLongArm = 0.09;    // arm that sees past a bite of 1.5 % of the diagonal, share of the diagonal
constexpr double kGuard = 0.055;     // past a bite of 2 %, share of the diagonal
constexpr double kNetArm = 0.11;     // share of the diagonal
constexpr double kNoCorner = 8;      // [degree] over the long arc: a bow
constexpr double kPlainCorner = 28;  // [degree] over the long arc: surely a corner
constexpr double kBend = 0.020;      // bend of an edge that is more than one edge, share of its length
constexpr double kHem = 0.65;        // weight of a hem's bends
constexpr double kShortEdge = 0.25;  // bites weigh less on an edge of this length and below, share of the diagonal
constexpr double kNoiseTurn = 18;    // [degree] what such a bite still turns the long arms

/// Polygon through the features, along the outline where only that can tell the course.
std::vector<cv::Point> explained(const Outline& outline, const GarmentTemplate& garment,
                                 const std::vector<int>& sample_of, double scale) {
  std::vector<cv::Point> polygon;
  const int n = static_cast<int>(outline.samples.size());
  const auto add = [&](int s) {
    const Vec2 p = outline.samples[s].at * scale;
    polygon.emplace_back(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
  };
  for (const TemplateEdge& edge : garment.edges) {
    add(sample_of[edge.from]);
    if (!follows_outline(garment, edge)) continue;
    for (int s = sample_of[edge.from]; s != sample_of[edge.to]; s = (s + 1) % n) add(s);
  }
  return polygon;
}

double overlap(const std::vector<cv::Point>& polygon, const cv::Mat& small_mask) {
  cv::Mat fill = cv::Mat::zeros(small_mask.size(), CV_8U);
  cv::fillPoly(fill, std::vector<std::vector<cv::Point>>{polygon}, 255);
  const int both = cv::countNonZero(fill & small_mask);
  const int any = cv::countNonZero(fill | small_mask);
  return any > 0 ? static_cast<double>(both) / any : 0;
}

/// What remains of the turn at `s` when the outline is seen over a long arc, inside the stretch `before` and `after` it
/// [samples]: a bite or a burr of the cut-out turns back within the arc, a corner of the garment does not.
double long_turn(const Outline& outline, int s, int before, int after) {
  const int n = static_cast<int>(outline.samples.size());
  const int arm = std::max(4, static_cast<int>(kLongArm * outline.diagonal / outline.step));
  const auto direction = [&](int sign, int reach) {
    // From the mean of the near half to the mean of the far half of the arm.
    const int half = std::max(2, std::min(arm, reach) / 2);
    Vec2 near = Vec2::Zero(), far = Vec2::Zero();
    for (int k = 0; k < half; ++k) {
      near += outline.samples[((s + sign * k) % n + n) % n].at;
      far += outline.samples[((s + sign * (k + half)) % n + n) % n].at;
    }
    return Vec2(sign * (far - near));
  };
  const Vec2 in = direction(-1, before), out = direction(1, after);
  return std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out)) * 180 / std::numbers::pi;
}

/// The turn [degree] between the stretches well before and well after `s`: whatever the outline does in between, a bite
/// of 2 % of the diagonal comes back to its old course. Shorter arms where the neighbours `before` and `after` are
/// near.
double net_turn(const Outline& outline, int s, int before, int after) {
  const int n = static_cast<int>(outline.samples.size());
  const auto direction = [&](int sign, int reach) {
    const int far = std::min(reach, static_cast<int>(kNetArm * outline.diagonal / outline.step));
    const int near = std::min(far / 2, static_cast<int>(kGuard * outline.diagonal / outline.step));
    const Vec2 a = outline.samples[((s + sign * near) % n + n) % n].at;
    const Vec2 b = outline.samples[((s + sign * far) % n + n) % n].at;
    return Vec2(sign * (b - a));
  };
  const Vec2 in = direction(-1, before), out = direction(1, after);
  return std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out)) * 180 / std::numbers::pi;
}

/// Where a side seam is drawn in: a feature between two seams at which the outline need not turn. What points outwards
/// there is no waist.
bool is_waist(const GarmentTemplate& garment, int feature) {
  if (garment.features[feature].turn != Turn::any) return false;
  return std::all_of(garment.edges.begin(), garment.edges.end(), [&](const TemplateEdge& edge) {
    return (edge.from != feature && edge.to != feature) ||
           (edge.kind == EdgeKind::seam && !follows_outline(garment, edge));
  });
}

/// Strong corners of the outline that no feature explains speak against the garment.
double unexplained(const Outline& outline, const GarmentTemplate& garment, const std::vector<int>& sample_of) {
  const int n = static_cast<int>(outline.samples.size());
  std::vector<char> waist;
  for (int f = 0; f < static_cast<int>(garment.features.size()); ++f) waist.push_back(is_waist(garment, f));
  double sum = 0;
  for (const TemplateEdge& edge : garment.edges) {
    if (follows_outline(garment, edge)) continue;
    // A seam is smooth; a hem may have frills and folds.
    const double gate = edge.kind == EdgeKind::seam ? 25 : 40;
    const int first = sample_of[edge.from], last = sample_of[edge.to];
    for (int s = first; s != last; s = (s + 1) % n) {
      const Sample& sample = outline.samples[s];
      if (sample.candidate < 0 || std::abs(sample.coarse_deg) < gate) continue;
      const int before = (s - first + n) % n, after = (last - s + n) % n;
      const double turn = std::min({std::abs(sample.coarse_deg), std::abs(long_turn(outline, s, before, after)),
                                    std::abs(net_turn(outline, s, before, after))});
      double nearest = kOutOfReach;
      for (std::size_t f = 0; f < sample_of.size(); ++f)
        if (!waist[f] || sample.coarse_deg < 0)
          nearest = std::min(nearest, (outline.samples[sample_of[f]].at - sample.at).norm());
      const double gap = nearest / outline.diagonal;
      if (gap > 0.06)
        sum += (edge.kind == EdgeKind::seam ? 1.6 : 0.6) * std::min(1.0, std::abs(sample.coarse_deg) / 90) *
               std::clamp((turn - kNoiseTurn) / (gate - kNoiseTurn), 0.0, 1.0) * std::min(1.0, (gap - 0.06) / 0.06);
    }
  }
  return sum;
}

/// RMS distance of an edge's course to the best cubic over its arc, share of its length: a seam and a cut edge are
/// plain curves.
double edge_bend(const Outline& outline, int first, int last) {
  const int n = static_cast<int>(outline.samples.size());
  const int count = (last - first + n) % n + 1;
  if (count < 12) return 0;
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Matrix<double, 4, 2> right = Eigen::Matrix<double, 4, 2>::Zero();
  double total = 0;
  const Vec2 origin = outline.samples[first].at;
  const auto row = [&](int k) {
    const double t = 2.0 * k / (count - 1) - 1;
    return Eigen::Vector4d(1, t, 1.5 * t * t - 0.5, 2.5 * t * t * t - 1.5 * t);
  };
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector4d r = row(k);
    const Vec2 p = (outline.samples[(first + k) % n].at - origin) / outline.diagonal;
    normal += r * r.transpose();
    right += r * p.transpose();
    total += p.squaredNorm();
  }
  const Eigen::Matrix<double, 4, 2> map = normal.ldlt().solve(right);
  const double rms = std::sqrt(std::max(0.0, (total - (right.array() * map.array()).sum()) / count));
  return rms / std::max(kShortEdge, count * outline.step / outline.diagonal);
}

/// An open edge across the lower end: it may have frills and hang in folds.
bool is_hem(const GarmentTemplate& garment, const TemplateEdge& edge) {
  const TemplatePose& pose = garment.poses.front();
  return edge.kind == EdgeKind::open && garment.features[edge.from].mirror == edge.to &&
         pose.uv[edge.from].y() + pose.uv[edge.to].y() > 1;
}

/// The worst edge; of two partners the better one counts most, because a hanger or a hand spoils one side.
double worst_bend(const Outline& outline, const GarmentTemplate& garment, const std::vector<int>& sample_of) {
  const int count = static_cast<int>(garment.edges.size());
  std::vector<double> bend(count, -1);
  for (int i = 0; i < count; ++i)
    if (!follows_outline(garment, garment.edges[i]))
      bend[i] = (is_hem(garment, garment.edges[i]) ? kHem : 1) *
                edge_bend(outline, sample_of[garment.edges[i].from], sample_of[garment.edges[i].to]);
  double worst = 0;
  for (int i = 0; i < count; ++i) {
    if (bend[i] < 0) continue;
    double other = bend[i];
    for (int k = 0; k < count; ++k)
      if (bend[k] >= 0 && garment.edges[k].from == garment.features[garment.edges[i].to].mirror &&
          garment.edges[k].to == garment.features[garment.edges[i].from].mirror)
        other = bend[k];
    worst = std::max(worst, 0.3 * std::max(bend[i], other) + 0.7 * std::min(bend[i], other));
  }
  return worst;
}

/// Every corner that the template asks for, as the turn between the stretches before and after it up to its neighbours.
void weigh_corners(const Outline& outline, const GarmentTemplate& garment, const std::vector<int>& sample_of,
                   Evidence& e) {
  const int n = static_cast<int>(outline.samples.size());
  const int count = static_cast<int>(garment.edges.size());
  std::vector<double> strength(count, 1);
  double sum = 0;
  int turning = 0;
  for (int i = 0; i < count; ++i) {
    const int f = garment.edges[i].from;
    const Turn turn = garment.features[f].turn;
    if (turn == Turn::any) continue;
    const int before = (sample_of[f] - sample_of[garment.edges[(i + count - 1) % count].from] + n) % n;
    const int after = (sample_of[garment.edges[i].to] - sample_of[f] + n) % n;
    const double degrees = long_turn(outline, sample_of[f], before, after) * static_cast<int>(turn);
    strength[f] = std::clamp((degrees - kNoCorner) / (kPlainCorner - kNoCorner), 0.0, 1.0);
    sum += strength[f];
    ++turning;
  }
  e.corners = turning > 0 ? sum / turning : 1;
  // A corner may be hidden on one side; when it is missing on both, the garment has no such corner.
  e.weakest = 1;
  for (int f = 0; f < count; ++f) {
    const int partner = garment.features[f].mirror;
    if (partner >= 0) e.weakest = std::min(e.weakest, std::max(strength[f], strength[partner]));
  }
}

void conclude(Evidence& e) {
  const double bent = e.bend / kBend;
  const double cover = std::clamp((e.cover - 0.6) / 0.15, 0.0, 1.0);
  const double edges = std::exp(-bent * bent * bent) * std::exp(-0.8 * e.stray);
  const double corners = std::clamp((e.corners - 0.4) / 0.35, 0.0, 1.0) * (0.6 + 0.4 * e.weakest);
  e.score = cover * edges * corners * e.reach;
  const double least = std::min({cover, edges, corners, e.reach});
  e.why = least == e.reach ? "it is too long or too short for one"
          : least == cover ? "its outline covers other areas"
          : least == edges ? "its outline has corners and bends that this garment lacks"
                           : "its outline lacks this garment's corners";
}

}  // namespace

bool follows_outline(const GarmentTemplate& garment, const TemplateEdge& edge) {
  if (edge.kind == EdgeKind::neck) return true;
  const auto joins = [&](int a, int b) { return (edge.from == a && edge.to == b) || (edge.from == b && edge.to == a); };
  return std::any_of(garment.limbs.begin(), garment.limbs.end(), [&](const TemplateLimb& limb) {
    // Sleeves are laid down bent; legs that meet in the middle lie straight, and their sides are plain curves.
    if (is_leg(garment, limb)) return false;
    return joins(limb.root_a, limb.tip_a) || joins(limb.root_b, limb.tip_b) || joins(limb.root_a, limb.tip_b) ||
           joins(limb.root_b, limb.tip_a);
  });
}

Evidence weigh(const Outline& outline, const cv::Mat& small_mask, double scale, const GarmentTemplate& garment,
               const std::vector<int>& sample_of) {
  Evidence e;
  e.cover = overlap(explained(outline, garment, sample_of, scale), small_mask);
  e.stray = unexplained(outline, garment, sample_of);
  e.bend = worst_bend(outline, garment, sample_of);
  weigh_corners(outline, garment, sample_of, e);
  std::vector<Vec2> at;
  for (const int s : sample_of) at.push_back(outline.samples[s].at);
  e.reach = body_reach(garment, at);
  conclude(e);
  return e;
}

}  // namespace vitrine::features_detail
