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
constexpr int kFineStride = 5;     // [samples] between plain states
constexpr int kCoarseStride = 14;  // the same for the first impression
constexpr int kSecondLooks = 6;    // frames looked at closely besides the best one of each pose

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
std::vector<State> states_of(const Outline& outline, const Vec2& target, double radius, Turn turn, int stride) {
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
    if (distance > radius || (!candidate && s % stride != 0)) continue;
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

/// Cheapest choice of one state per feature that walks once around the outline in order: a dynamic programme for each
/// start, cut short where what is left to come cannot make up for what has been spent.
double choose(const Outline& outline, const std::vector<std::vector<State>>& states, const std::vector<Vec2>& targets,
              const std::vector<double>& radius, std::vector<int>& chosen) {
  const int count = static_cast<int>(states.size());
  const int n = static_cast<int>(outline.samples.size());
  const auto shape = [&](int i, int j, const State& a, const State& b) {
    const Vec2 moved = (outline.samples[b.sample].at - outline.samples[a.sample].at) - (targets[j] - targets[i]);
    const double scale = radius[i] + radius[j];
    return kShape * 4 * moved.squaredNorm() / (scale * scale);
  };
  // What the features after each state cost at least: the same programme without the order and without the way home.
  std::vector<std::vector<double>> ahead(count), cost(count);
  std::vector<std::vector<int>> from(count), along(count);
  for (int i = count - 1; i >= 0; --i) {
    ahead[i].assign(states[i].size(), i == count - 1 ? 0 : kFar);
    for (std::size_t a = 0; i < count - 1 && a < states[i].size(); ++a)
      for (std::size_t b = 0; b < states[i + 1].size(); ++b)
        ahead[i][a] = std::min(
            ahead[i][a], shape(i, i + 1, states[i][a], states[i + 1][b]) + states[i + 1][b].cost + ahead[i + 1][b]);
  }
  double best_total = kFar;
  const auto hopeless = [&](double spent, double least) { return spent + least > best_total + 1e-9; };
  std::vector<int> starts(states[0].size());
  for (std::size_t k = 0; k < starts.size(); ++k) starts[k] = static_cast<int>(k);
  std::stable_sort(starts.begin(), starts.end(),
                   [&](int a, int b) { return states[0][a].cost + ahead[0][a] < states[0][b].cost + ahead[0][b]; });
  for (const int first : starts) {
    if (hopeless(states[0][first].cost, ahead[0][first])) break;
    const int origin = states[0][first].sample;
    for (int i = 0; i < count; ++i) {
      cost[i].assign(states[i].size(), kFar);
      from[i].assign(states[i].size(), -1);
      along[i].resize(states[i].size());
      for (std::size_t b = 0; b < states[i].size(); ++b) along[i][b] = (states[i][b].sample - origin + n) % n;
    }
    cost[0][first] = states[0][first].cost;
    for (int i = 1; i < count; ++i)
      for (std::size_t a = 0; a < states[i - 1].size(); ++a) {
        if (cost[i - 1][a] >= kFar || hopeless(cost[i - 1][a], ahead[i - 1][a])) continue;
        for (std::size_t b = 0; b < states[i].size(); ++b) {
          if (along[i][b] <= along[i - 1][a]) continue;
          const double c = cost[i - 1][a] + shape(i - 1, i, states[i - 1][a], states[i][b]) + states[i][b].cost;
          if (c >= cost[i][b]) continue;
          cost[i][b] = c;
          from[i][b] = static_cast<int>(a);
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

/// Where a pose puts its features in a frame, in the outline's order.
void aim(const GarmentTemplate& garment, const std::vector<int>& order, int pose_index, const Frame& frame,
         std::vector<Vec2>& targets, std::vector<double>& radius) {
  const TemplatePose& pose = garment.poses[pose_index];
  const Vec2 size = frame.high - frame.low;
  targets.clear();
  radius.clear();
  for (const int f : order) {
    targets.push_back(rotated(frame.low + pose.uv[f].cwiseProduct(size), frame.tilt_deg));
    radius.push_back(pose.radius[f] * size.norm());
  }
}

/// First impression of a pose in a frame: few states, one round.
double coarse_cost(const Outline& outline, const GarmentTemplate& garment, const std::vector<int>& order,
                   int pose_index, const Frame& frame) {
  std::vector<Vec2> targets;
  std::vector<double> radius;
  aim(garment, order, pose_index, frame, targets, radius);
  std::vector<std::vector<State>> states;
  for (std::size_t i = 0; i < order.size(); ++i)
    states.push_back(states_of(outline, targets[i], radius[i], garment.features[order[i]].turn, kCoarseStride));
  std::vector<int> chosen;
  return choose(outline, states, targets, radius, chosen) / static_cast<double>(order.size()) +
         0.15 * std::pow(frame.tilt_deg / 20, 2);
}

Match try_pose(const Outline& outline, const cv::Mat& small_mask, double scale, const GarmentTemplate& garment,
               const std::vector<int>& order, int pose_index, const Frame& frame) {
  const int count = static_cast<int>(order.size());
  std::vector<Vec2> targets;
  std::vector<double> radius;
  aim(garment, order, pose_index, frame, targets, radius);
  Match match;
  match.pose = pose_index;
  match.tilt_deg = frame.tilt_deg;
  std::vector<std::vector<State>> states(count);
  std::vector<int> chosen;
  double total = kFar;
  for (int round = 0; round < 2; ++round) {
    for (int i = 0; i < count; ++i)
      states[i] = states_of(outline, targets[i], radius[i], garment.features[order[i]].turn, kFineStride);
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
  }
  match.evidence = weigh(outline, small_mask, scale, garment, sample_of);
  const double cover = match.evidence.cover, stray = match.evidence.stray;
  match.cost = total / count + 4 * (1 - cover) + 0.25 * stray + 0.15 * std::pow(frame.tilt_deg / 20, 2);
  match.score = match.evidence.score;
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
  struct Look {
    double cost;
    int pose;
    Frame frame;
  };
  std::vector<Look> looks;
  for (const double tilt : {0.0, -7.0, 7.0, -14.0, 14.0, -20.0, 20.0}) {
    Frame frame{tilt, Vec2::Constant(kFar), Vec2::Constant(-kFar)};
    for (const Sample& s : outline.samples) {
      const Vec2 p = rotated(s.at, -tilt);
      frame.low = frame.low.cwiseMin(p);
      frame.high = frame.high.cwiseMax(p);
    }
    for (int pose = 0; pose < static_cast<int>(garment.poses.size()); ++pose)
      looks.push_back({coarse_cost(outline, garment, order, pose, frame), pose, frame});
  }
  std::stable_sort(looks.begin(), looks.end(), [](const Look& a, const Look& b) { return a.cost < b.cost; });
  Match best;
  std::vector<char> seen(garment.poses.size(), 0);
  int more = kSecondLooks;
  for (const Look& look : looks) {
    if (seen[look.pose] && more-- <= 0) continue;
    seen[look.pose] = 1;
    Match match = try_pose(outline, small_mask, scale, garment, order, look.pose, look.frame);
    if (match.cost < best.cost) best = std::move(match);
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
