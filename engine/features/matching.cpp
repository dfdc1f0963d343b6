// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace vitrine::features_detail {
namespace {

constexpr double kStrongTurn = 70;  // [degree] a corner that leaves no doubt
constexpr double kReward = 0.9;     // what such a corner is worth, in squared search radii
constexpr double kWrongTurn = 0.6;  // penalty for a corner that turns the other way
constexpr double kShape = 0.35;     // weight of the distance between neighbouring features
constexpr double kFar = 1e18;
constexpr double kLongArm = 0.09;  // arm that sees past a bite of 1.5 % of the diagonal, share of the diagonal
constexpr double kNoiseTurn = 18;  // [degree] what such a bite still turns the long arms

struct State {
  int sample = 0;
  double cost = 0;
  bool snapped = false;
};

Vec2 rotated(const Vec2& p, double degrees) {
  const double a = degrees * std::numbers::pi / 180;
  return {std::cos(a) * p.x() - std::sin(a) * p.y(), std::sin(a) * p.x() + std::cos(a) * p.y()};
}

double corner_reward(const Sample& sample, Turn turn) {
  const double strength = std::min(1.0, std::abs(sample.turn_deg) / kStrongTurn);
  if (turn != Turn::any && sample.turn_deg * static_cast<int>(turn) < 0) return -kWrongTurn * strength;
  return sample.candidate >= 0 ? kReward * strength : 0;
}

/// What one feature may choose from: candidates in its search radius, and plain outline samples for the case that the
/// corner is rounded away.
std::vector<State> states_of(const Outline& outline, const Vec2& target, double radius, Turn turn) {
  std::vector<State> states;
  int nearest = 0;
  double nearest_distance = kFar;
  const int n = static_cast<int>(outline.samples.size());
  for (int s = 0; s < n; ++s) {
    const Sample& sample = outline.samples[s];
    const double distance = (sample.at - target).norm();
    if (distance < nearest_distance) {
      nearest_distance = distance;
      nearest = s;
    }
    const bool candidate = sample.candidate >= 0;
    if (distance > radius || (!candidate && s % 5 != 0)) continue;
    const double d = distance / radius;
    states.push_back({s, d * d - corner_reward(sample, turn), candidate});
  }
  if (states.empty()) {
    // Nothing in reach: the nearest stretch of outline, wide enough for the order around it to hold.
    for (int k = -40; k <= 40; k += 4) {
      const int s = ((nearest + k) % n + n) % n;
      const double d = (outline.samples[s].at - target).norm() / radius;
      states.push_back({s, d * d - corner_reward(outline.samples[s], turn), false});
    }
  }
  return states;
}

/// Cheapest choice of one state per feature that walks once around the outline in order.
double choose(const Outline& outline, const std::vector<std::vector<State>>& states, const std::vector<Vec2>& targets,
              const std::vector<double>& radius, std::vector<int>& chosen) {
  const int count = static_cast<int>(states.size());
  const int n = static_cast<int>(outline.samples.size());
  const auto shape = [&](int i, int j, const State& a, const State& b) {
    const Vec2 moved = (outline.samples[b.sample].at - outline.samples[a.sample].at) - (targets[j] - targets[i]);
    const double scale = radius[i] + radius[j];
    return kShape * 4 * moved.squaredNorm() / (scale * scale);
  };
  double best_total = kFar;
  for (std::size_t first = 0; first < states[0].size(); ++first) {
    const int origin = states[0][first].sample;
    const auto along = [&](const State& s) { return (s.sample - origin + n) % n; };
    std::vector<std::vector<double>> cost(count);
    std::vector<std::vector<int>> from(count);
    cost[0].assign(states[0].size(), kFar);
    cost[0][first] = states[0][first].cost;
    for (int i = 1; i < count; ++i) {
      cost[i].assign(states[i].size(), kFar);
      from[i].assign(states[i].size(), -1);
      for (std::size_t b = 0; b < states[i].size(); ++b) {
        for (std::size_t a = 0; a < states[i - 1].size(); ++a) {
          if (cost[i - 1][a] >= kFar || along(states[i][b]) <= along(states[i - 1][a])) continue;
          const double c = cost[i - 1][a] + shape(i - 1, i, states[i - 1][a], states[i][b]);
          if (c < cost[i][b]) {
            cost[i][b] = c;
            from[i][b] = static_cast<int>(a);
          }
        }
        cost[i][b] += states[i][b].cost;
      }
    }
    for (std::size_t b = 0; b < states[count - 1].size(); ++b) {
      if (cost[count - 1][b] >= kFar / 2) continue;
      const double total = cost[count - 1][b] + shape(count - 1, 0, states[count - 1][b], states[0][first]);
      if (total >= best_total) continue;
      best_total = total;
      chosen.assign(count, 0);
      int at = static_cast<int>(b);
      for (int i = count - 1; i >= 0; --i) {
        chosen[i] = at;
        if (i > 0) at = from[i][at];
      }
    }
  }
  return best_total;
}

/// Affine map of the targets onto the chosen points, drawn to the identity: few points, some of them wrong.
std::vector<Vec2> refitted(const std::vector<Vec2>& targets, const std::vector<Vec2>& found,
                           const std::vector<double>& weight, double diagonal) {
  Vec2 centre = Vec2::Zero();
  double total = 0;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    centre += weight[i] * targets[i];
    total += weight[i];
  }
  centre /= total;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Vec2 t = (targets[i] - centre) / diagonal;
    const Vec2 f = (found[i] - targets[i]) / diagonal;
    const Eigen::Vector3d row(t.x(), t.y(), 1);
    normal += weight[i] * row * row.transpose();
    right += weight[i] * row * f.transpose();
  }
  normal.diagonal() += Eigen::Vector3d(0.05, 0.05, 0.02);
  const Eigen::Matrix<double, 3, 2> map = normal.ldlt().solve(right);
  std::vector<Vec2> result(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Vec2 t = (targets[i] - centre) / diagonal;
    result[i] = targets[i] + diagonal * (map.transpose() * Eigen::Vector3d(t.x(), t.y(), 1));
  }
  return result;
}

/// Edges whose course the features do not settle: a plugin shapes the neckline, and a sleeve may bend.
bool follows_outline(const GarmentTemplate& garment, const TemplateEdge& edge) {
  if (edge.kind == EdgeKind::neck) return true;
  const auto joins = [&](int a, int b) { return (edge.from == a && edge.to == b) || (edge.from == b && edge.to == a); };
  return std::any_of(garment.limbs.begin(), garment.limbs.end(), [&](const TemplateLimb& limb) {
    return joins(limb.root_a, limb.tip_a) || joins(limb.root_b, limb.tip_b) || joins(limb.root_a, limb.tip_b) ||
           joins(limb.root_b, limb.tip_a);
  });
}

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
  return std::abs(std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out))) * 180 / std::numbers::pi;
}

/// Strong corners of the outline that no feature explains speak against the garment.
double unexplained(const Outline& outline, const GarmentTemplate& garment, const std::vector<int>& sample_of) {
  const int n = static_cast<int>(outline.samples.size());
  double sum = 0;
  for (const TemplateEdge& edge : garment.edges) {
    if (follows_outline(garment, edge)) continue;
    // A seam is smooth; a hem may have frills and folds.
    const double gate = edge.kind == EdgeKind::seam ? 25 : 40;
    const int first = sample_of[edge.from], last = sample_of[edge.to];
    for (int s = first; s != last; s = (s + 1) % n) {
      const Sample& sample = outline.samples[s];
      if (sample.candidate < 0 || std::abs(sample.coarse_deg) < gate) continue;
      const double turn =
          std::min(std::abs(sample.coarse_deg), long_turn(outline, s, (s - first + n) % n, (last - s + n) % n));
      double nearest = kFar;
      for (const int f : sample_of) nearest = std::min(nearest, (outline.samples[f].at - sample.at).norm());
      const double gap = nearest / outline.diagonal;
      if (gap > 0.06)
        sum += (edge.kind == EdgeKind::seam ? 1.6 : 0.6) * std::min(1.0, std::abs(sample.coarse_deg) / 90) *
               std::clamp((turn - kNoiseTurn) / (gate - kNoiseTurn), 0.0, 1.0) * std::min(1.0, (gap - 0.06) / 0.06);
    }
  }
  return sum;
}

/// A feature that need not be a corner (a shoulder over a sleeve) goes where its neighbours in the template say: the
/// pose's offset from the snapped features around it, the near ones weighing most.
void place_soft(const Outline& outline, const GarmentTemplate& garment, const std::vector<int>& order,
                const std::vector<Vec2>& targets, std::vector<std::vector<State>>& states, std::vector<int>& chosen) {
  const int count = static_cast<int>(order.size());
  const int n = static_cast<int>(outline.samples.size());
  for (int i = 0; i < count; ++i) {
    if (garment.features[order[i]].turn != Turn::any) continue;
    Vec2 sum = Vec2::Zero();
    double total = 0;
    for (int k = 0; k < count; ++k) {
      const State& other = states[k][chosen[k]];
      if (k == i || !other.snapped || garment.features[order[k]].turn == Turn::any) continue;
      const double near = (targets[k] - targets[i]).squaredNorm() / (outline.diagonal * outline.diagonal);
      const double weight = 1 / (near * near + 1e-4);
      sum += weight * (outline.samples[other.sample].at - targets[k]);
      total += weight;
    }
    if (total <= 0) continue;
    const Vec2 wanted = targets[i] + sum / total;
    const int before = states[(i + count - 1) % count][chosen[(i + count - 1) % count]].sample;
    const int after = states[(i + 1) % count][chosen[(i + 1) % count]].sample;
    State best = states[i][chosen[i]];
    double nearest = kFar;
    for (int s = (before + 3) % n; s != after; s = (s + 1) % n) {
      const Sample& sample = outline.samples[s];
      const double snap = sample.candidate >= 0 ? 0.7 : 1.0;  // a bend close by is the better guess
      const double distance = snap * (sample.at - wanted).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      best = {s, 0, sample.candidate >= 0};
    }
    states[i][chosen[i]] = best;
  }
}

struct Frame {
  double tilt_deg = 0;
  Vec2 low, high;  // bounding box in the turned frame
};

Match try_pose(const Outline& outline, const cv::Mat& small_mask, double scale, const GarmentTemplate& garment,
               const std::vector<int>& order, int pose_index, const Frame& frame) {
  const TemplatePose& pose = garment.poses[pose_index];
  const int count = static_cast<int>(order.size());
  const Vec2 size = frame.high - frame.low;
  std::vector<Vec2> targets(count);
  std::vector<double> radius(count);
  for (int i = 0; i < count; ++i) {
    const Vec2& uv = pose.uv[order[i]];
    targets[i] = rotated(frame.low + Vec2(uv.x() * size.x(), uv.y() * size.y()), frame.tilt_deg);
    radius[i] = pose.radius[order[i]] * size.norm();
  }
  Match match;
  match.pose = pose_index;
  match.tilt_deg = frame.tilt_deg;
  std::vector<std::vector<State>> states(count);
  std::vector<int> chosen;
  double total = kFar;
  for (int round = 0; round < 2; ++round) {
    for (int i = 0; i < count; ++i)
      states[i] = states_of(outline, targets[i], radius[i], garment.features[order[i]].turn);
    total = choose(outline, states, targets, radius, chosen);
    if (total >= kFar / 2) return match;
    if (round == 1) break;
    std::vector<Vec2> found(count);
    std::vector<double> weight(count);
    for (int i = 0; i < count; ++i) {
      const State& s = states[i][chosen[i]];
      found[i] = outline.samples[s.sample].at;
      weight[i] = s.snapped ? 1.0 : 0.3;
    }
    targets = refitted(targets, found, weight, outline.diagonal);
  }
  place_soft(outline, garment, order, targets, states, chosen);
  match.features.resize(count);
  std::vector<int> sample_of(count);
  double certainty = 0, worst = 1;
  for (int i = 0; i < count; ++i) {
    const State& s = states[i][chosen[i]];
    const Sample& sample = outline.samples[s.sample];
    const Turn turn = garment.features[order[i]].turn;
    const double d = (sample.at - targets[i]).norm() / radius[i];
    const double corner = std::max(0.0, corner_reward(sample, turn)) / kReward;
    Placed& placed = match.features[order[i]];
    placed.sample = s.sample;
    placed.snapped = s.snapped && corner > 0;
    placed.confidence = std::exp(-d * d) * (placed.snapped ? 0.5 + 0.5 * corner : 0.35);
    sample_of[order[i]] = s.sample;
    if (turn != Turn::any) {
      certainty += placed.confidence;
      worst = std::min(worst, placed.confidence);
    }
  }
  // A corner may be hidden on one side; when it is missing on both, the garment has no such corner.
  double weakest = 1;
  for (int f = 0; f < count; ++f) {
    const int partner = garment.features[f].mirror;
    if (garment.features[f].turn == Turn::any || partner < 0) continue;
    weakest = std::min(weakest, std::max(match.features[f].confidence, match.features[partner].confidence));
  }
  int turning = 0;
  for (const TemplateFeature& f : garment.features) turning += f.turn != Turn::any;
  certainty = turning > 0 ? certainty / turning : 0.7;
  const double cover = overlap(explained(outline, garment, sample_of, scale), small_mask);
  const double stray = unexplained(outline, garment, sample_of);
  match.cost = total / count + 4 * (1 - cover) + 0.25 * stray + 0.15 * std::pow(frame.tilt_deg / 20, 2);
  const double cover_score = std::clamp((cover - 0.55) / 0.2, 0.0, 1.0);
  const double stray_score = std::exp(-0.9 * stray);
  const double corner_score =
      std::clamp((certainty - 0.6) / 0.15, 0.0, 1.0) * std::clamp((weakest - 0.1) / 0.25, 0.0, 1.0);
  match.score = cover_score * stray_score * corner_score;
  match.why = cover_score <= stray_score && cover_score <= corner_score ? "its outline covers other areas"
              : stray_score <= corner_score ? "its outline has corners that this garment lacks"
                                            : "its outline lacks this garment's corners";
  return match;
}

}  // namespace

std::vector<int> outline_order(const GarmentTemplate& garment) {
  std::vector<int> order;
  for (const TemplateEdge& edge : garment.edges) order.push_back(edge.from);
  return order;
}

Match match_template(const Outline& outline, const cv::Mat& mask, const GarmentTemplate& garment) {
  const std::vector<int> order = outline_order(garment);
  const double scale = std::min(1.0, 240.0 / std::max(mask.cols, mask.rows));
  cv::Mat small_mask;
  cv::resize(mask, small_mask, {}, scale, scale, cv::INTER_AREA);
  small_mask = small_mask > 127;
  Match best;
  for (const double tilt : {0.0, -7.0, 7.0, -14.0, 14.0, -20.0, 20.0}) {
    Frame frame{tilt, Vec2::Constant(kFar), Vec2::Constant(-kFar)};
    for (const Sample& s : outline.samples) {
      const Vec2 p = rotated(s.at, -tilt);
      frame.low = frame.low.cwiseMin(p);
      frame.high = frame.high.cwiseMax(p);
    }
    for (int pose = 0; pose < static_cast<int>(garment.poses.size()); ++pose) {
      Match match = try_pose(outline, small_mask, scale, garment, order, pose, frame);
      if (match.cost < best.cost) best = std::move(match);
    }
  }
  return best;
}

double tilt_of(const std::vector<Vec2>& points, const GarmentTemplate& garment, double fallback_deg) {
  // Long pairs say more about the direction than short ones: the sum of the vectors weighs them so.
  Vec2 across = Vec2::Zero();
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    const int partner = garment.features[i].mirror;
    if (partner <= i) continue;
    Vec2 v = points[partner] - points[i];
    if (v.x() < 0) v = -v;
    across += v;
  }
  if (across.norm() < 1e-9) return fallback_deg;
  return std::atan2(across.y(), across.x()) * 180 / std::numbers::pi;
}

}  // namespace vitrine::features_detail
