// SPDX-License-Identifier: GPL-3.0-or-later
#include "outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace vitrine::features_detail {
namespace {

constexpr double kDegree = 180.0 / std::numbers::pi;
constexpr double kSampleShare = 1.0 / 600;  // sample spacing, share of the box diagonal
constexpr double kCoarseArc = 0.035;        // arc that still sees a rounded corner, share of the box diagonal
constexpr double kCoarseGate = 1.25;        // a gentle bow turns more over the coarse arc, so that its gate is higher
// Half of a clean outline turns less than this over the fine arc, whatever the garment; where it turns more, the
// cut-out is rough and is seen over longer arcs, so that corners stand out from the noise again.
constexpr double kRoughTurn = 8;     // [degree]
constexpr double kMaxSmoothing = 3;  // times the arc asked for
constexpr double kSmoothingStep = 1.3;

double turn_at(const std::vector<Sample>& samples, int i, int arm) {
  const int n = static_cast<int>(samples.size());
  const Vec2 before = samples[i].at - samples[(i - arm + n) % n].at;
  const Vec2 after = samples[(i + arm) % n].at - samples[i].at;
  const double cross = before.x() * after.y() - before.y() * after.x();
  return std::atan2(cross, before.dot(after)) * kDegree;
}

/// One sample per run over the threshold: the highest of the run.
std::vector<int> run_peaks(const std::vector<double>& turn, double threshold) {
  const int n = static_cast<int>(turn.size());
  const auto sign = [&](int i) { return turn[i] > threshold ? 1 : turn[i] < -threshold ? -1 : 0; };
  int start = 0;
  while (start < n && sign(start) != 0) ++start;
  if (start == n) return {};
  std::vector<int> peaks;
  int best = -1;
  for (int k = 1; k <= n; ++k) {
    const int i = (start + k) % n;
    const int before = (i + n - 1) % n;
    if (best >= 0 && sign(i) != sign(before)) {
      peaks.push_back(best);
      best = -1;
    }
    if (sign(i) != 0 && (best < 0 || std::abs(turn[i]) > std::abs(turn[best]))) best = i;
  }
  return peaks;
}

void sample_chain(Outline& outline, double sigma) {
  const std::vector<Vec2> smooth = smooth_closed(outline.chain, sigma, {});
  const int n = static_cast<int>(smooth.size());
  std::vector<double> arc(n + 1, 0);
  for (int i = 0; i < n; ++i) arc[i + 1] = arc[i] + (smooth[(i + 1) % n] - smooth[i]).norm();
  const int count = std::max(16, static_cast<int>(arc[n] / (outline.diagonal * kSampleShare)));
  outline.step = arc[n] / count;
  int k = 0;
  for (int s = 0; s < count; ++s) {
    const double target = outline.step * s;
    while (k + 1 < n && arc[k + 1] <= target) ++k;
    const double length = arc[k + 1] - arc[k];
    const double t = length > 0 ? (target - arc[k]) / length : 0;
    Sample sample;
    sample.at = smooth[k] + t * (smooth[(k + 1) % n] - smooth[k]);
    sample.chain = t < 0.5 ? k : (k + 1) % n;
    outline.samples.push_back(sample);
  }
}

int fine_arm(const Outline& outline, double fine_arc) {
  const int limit = std::max(1, static_cast<int>(outline.samples.size()) / 8);
  return std::clamp(static_cast<int>(std::lround(fine_arc / outline.step)), 2, std::max(2, limit));
}

/// Median turn over the fine arc [degree].
double roughness(const Outline& outline, int arm) {
  std::vector<double> turns(outline.samples.size());
  for (std::size_t i = 0; i < turns.size(); ++i)
    turns[i] = std::abs(turn_at(outline.samples, static_cast<int>(i), arm));
  std::nth_element(turns.begin(), turns.begin() + static_cast<std::ptrdiff_t>(turns.size() / 2), turns.end());
  return turns[turns.size() / 2];
}

void find_candidates(Outline& outline, double fine_arc, double min_turn_deg) {
  const int n = static_cast<int>(outline.samples.size());
  const int limit = std::max(1, n / 8);
  const int fine = fine_arm(outline, fine_arc);
  const int coarse = std::clamp(static_cast<int>(std::lround(outline.diagonal * kCoarseArc / outline.step)), fine,
                                std::max(fine, limit));
  std::vector<double> fine_turn(n), coarse_turn(n);
  for (int i = 0; i < n; ++i) {
    fine_turn[i] = turn_at(outline.samples, i, fine);
    coarse_turn[i] = turn_at(outline.samples, i, coarse);
    outline.samples[i].coarse_deg = coarse_turn[i];
    outline.samples[i].turn_deg = std::abs(fine_turn[i]) > std::abs(coarse_turn[i]) ? fine_turn[i] : coarse_turn[i];
  }
  std::vector<int> peaks = run_peaks(fine_turn, min_turn_deg);
  for (const int p : run_peaks(coarse_turn, min_turn_deg * kCoarseGate)) {
    const bool known = std::any_of(peaks.begin(), peaks.end(), [&](int q) {
      const int gap = std::abs(p - q);
      return std::min(gap, n - gap) < coarse && fine_turn[q] * coarse_turn[p] > 0;
    });
    if (!known) peaks.push_back(p);
  }
  std::sort(peaks.begin(), peaks.end());
  for (const int p : peaks) {
    Sample& sample = outline.samples[p];
    if (sample.candidate >= 0) continue;
    sample.candidate = static_cast<int>(outline.candidates.size());
    outline.candidates.push_back({outline.chain[sample.chain], sample.turn_deg, sample.chain});
  }
}

}  // namespace

double signed_area(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& a = polygon[i];
    const Vec2& b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return twice / 2;
}

std::vector<Vec2> smooth_closed(const std::vector<Vec2>& points, double sigma, const std::vector<char>& pinned) {
  const int n = static_cast<int>(points.size());
  const int reach = std::min(static_cast<int>(std::ceil(3 * sigma)), (n - 1) / 2);
  if (reach < 1) return points;
  std::vector<double> weight(reach + 1);
  for (int k = 0; k <= reach; ++k) weight[k] = std::exp(-0.5 * k * k / (sigma * sigma));
  std::vector<Vec2> result(n);
  for (int i = 0; i < n; ++i) {
    // A pinned point is the end of the window on its side, and the window stays symmetric so that nothing slides.
    int span = reach;
    if (!pinned.empty()) {
      for (int k = 0; k <= span; ++k)
        if (pinned[(i + k) % n] || pinned[(i - k + n) % n]) span = k;
    }
    Vec2 sum = points[i] * weight[0];
    double total = weight[0];
    for (int k = 1; k <= span; ++k) {
      sum += weight[k] * (points[(i + k) % n] + points[(i - k + n) % n]);
      total += 2 * weight[k];
    }
    result[i] = sum / total;
  }
  return result;
}

cv::Mat clean_mask(const cv::Mat& mask, int hair) {
  cv::Mat whole = cv::Mat::zeros(mask.size(), CV_8U);
  // Beyond the mask's box there is nothing to clean.
  const cv::Rect box = cv::boundingRect(mask);
  if (box.empty()) return whole;
  cv::Mat binary = mask(box) != 0;
  if (hair > 0) {
    const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * hair + 1, 2 * hair + 1});
    // A border of background lets the opening treat a garment at the frame like one in the middle.
    cv::Mat padded;
    cv::copyMakeBorder(binary, padded, hair, hair, hair, hair, cv::BORDER_CONSTANT, 0);
    cv::morphologyEx(padded, padded, cv::MORPH_OPEN, kernel);
    binary = padded(cv::Rect(hair, hair, box.width, box.height)).clone();
  }
  cv::Mat labels, stats, centres;
  const int count = cv::connectedComponentsWithStats(binary, labels, stats, centres, 4);
  int best = 0;
  for (int i = 1; i < count; ++i)
    if (best == 0 || stats.at<int>(i, cv::CC_STAT_AREA) > stats.at<int>(best, cv::CC_STAT_AREA)) best = i;
  if (best == 0) return whole;
  cv::Mat piece = labels == best;
  // Two pixels that meet at a corner only: the outline would touch itself there, and a gap one pixel wide would close.
  for (int y = 0; y + 1 < piece.rows; ++y) {
    uchar* a = piece.ptr<uchar>(y);
    uchar* b = piece.ptr<uchar>(y + 1);
    for (int x = 0; x + 1 < piece.cols; ++x) {
      if (a[x] && b[x + 1] && !a[x + 1] && !b[x])
        b[x + 1] = 0;
      else if (!a[x] && !b[x + 1] && a[x + 1] && b[x])
        b[x] = 0;
    }
  }
  piece.copyTo(whole(box));
  return whole;
}

Outline trace_outline(const cv::Mat& mask, const FeatureOptions& options) {
  Outline outline;
  cv::Mat padded;
  cv::copyMakeBorder(mask, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::Mat eroded;
  cv::erode(padded, eroded, cv::Mat::ones(3, 3, CV_8U));
  const cv::Mat boundary = padded & ~eroded;
  std::vector<std::vector<cv::Point>> walks;
  cv::findContours(padded.clone(), walks, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE, {-1, -1});
  const auto longest =
      std::max_element(walks.begin(), walks.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  if (longest == walks.end() || longest->size() < 32) return outline;
  const auto on_boundary = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < mask.cols && y < mask.rows && boundary.at<uchar>(y + 1, x + 1) != 0;
  };
  // The walk may step diagonally; the boundary left by the 3x3 erosion is 4-connected, so the pixel in between is on
  // it.
  for (std::size_t i = 0; i < longest->size(); ++i) {
    const cv::Point a = (*longest)[i];
    const cv::Point b = (*longest)[(i + 1) % longest->size()];
    outline.chain.emplace_back(a.x, a.y);
    if (a.x == b.x || a.y == b.y) continue;
    if (on_boundary(a.x, b.y))
      outline.chain.emplace_back(a.x, b.y);
    else if (on_boundary(b.x, a.y))
      outline.chain.emplace_back(b.x, a.y);
  }
  if (signed_area(outline.chain) < 0) std::reverse(outline.chain.begin(), outline.chain.end());
  outline.box = cv::boundingRect(*longest);
  outline.diagonal = std::hypot(outline.box.width, outline.box.height);
  const double asked = std::max(1.5, options.smoothing * outline.diagonal);
  double sigma = asked;
  sample_chain(outline, sigma);
  while (roughness(outline, fine_arm(outline, 3 * sigma)) > kRoughTurn &&
         kSmoothingStep * sigma <= kMaxSmoothing * asked) {
    sigma *= kSmoothingStep;
    outline.samples.clear();
    sample_chain(outline, sigma);
  }
  find_candidates(outline, 3 * sigma, options.min_turn_deg);
  return outline;
}

bool is_simple(const std::vector<Vec2>& polygon) {
  const int n = static_cast<int>(polygon.size());
  if (n < 3) return false;
  const auto side = [](const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  };
  // Sorted sweep over x keeps this near linear: outlines have thousands of short edges.
  std::vector<int> order(n);
  for (int i = 0; i < n; ++i) order[i] = i;
  const auto low = [&](int i) { return std::min(polygon[i].x(), polygon[(i + 1) % n].x()); };
  const auto high = [&](int i) { return std::max(polygon[i].x(), polygon[(i + 1) % n].x()); };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return low(a) != low(b) ? low(a) < low(b) : a < b; });
  std::vector<int> open;
  for (const int e : order) {
    std::erase_if(open, [&](int o) { return high(o) < low(e); });
    const Vec2& a = polygon[e];
    const Vec2& b = polygon[(e + 1) % n];
    for (const int o : open) {
      if (o == (e + 1) % n || e == (o + 1) % n) continue;
      const Vec2& c = polygon[o];
      const Vec2& d = polygon[(o + 1) % n];
      if (std::max(a.y(), b.y()) < std::min(c.y(), d.y()) || std::max(c.y(), d.y()) < std::min(a.y(), b.y())) continue;
      if (side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0) return false;
    }
    open.push_back(e);
  }
  return true;
}

}  // namespace vitrine::features_detail
