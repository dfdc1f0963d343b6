// SPDX-License-Identifier: GPL-3.0-or-later
#include "neckline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace vitrine::features_detail {
namespace {

// The search runs in the neck's own frame: u along the line between the neck points (0..1), v towards the hem in the
// same unit, `kUnit` pixels to a unit.
constexpr int kUnit = 160;
constexpr double kMarginU = 0.1, kMarginV = 0.25, kReachV = 1.75;
constexpr int kCurve = 64;  // samples along a curve
// A silhouette whose top edge is already as deep as a front neckline shows no inside, or a sliver: then only a very
// clear line is believed.
constexpr double kDeepTop = 0.4;
constexpr double kMinEvidence = 0.48, kMinEvidenceDeep = 0.6;
constexpr double kBelowTop = 0.12;  // a front neckline lies at least this far below the back's

struct NeckFrame {
  Vec2 origin, along, down;  // px, px per unit
  Vec2 pixel(const Vec2& uv) const { return origin + uv.x() * along + uv.y() * down; }
  Vec2 uv(const Vec2& p) const {
    const double w2 = along.squaredNorm();
    return {(p - origin).dot(along) / w2, (p - origin).dot(down) / w2};
  }
};

struct Field {
  std::vector<cv::Mat> gx, gy;  // CV_32F, one per Lab channel, zero where the neighbourhood leaves the garment
  double noise = 1;
};

cv::Point2d cell(const Vec2& uv) {
  return {(uv.x() + kMarginU) * kUnit, (uv.y() + kMarginV) * kUnit};
}

/// Gradient of the garment in the neck frame.
Field gradient_field(const Image& rgb, const cv::Mat& mask, const NeckFrame& frame, bool coarse) {
  const cv::Size size(static_cast<int>((1 + 2 * kMarginU) * kUnit), static_cast<int>((kMarginV + kReachV) * kUnit));
  // The picture is smoothed to the frame's resolution first, so that a large photo does not alias.
  const double shrink = frame.along.norm() / kUnit;
  const cv::Mat source(rgb.height, rgb.width, CV_8UC3, const_cast<std::uint8_t*>(rgb.data.data()));
  const Vec2 corner = frame.pixel({-kMarginU, -kMarginV});
  const Vec2 du = frame.along / kUnit, dv = frame.down / kUnit;
  const cv::Mat map = (cv::Mat_<double>(2, 3) << du.x(), dv.x(), corner.x(), du.y(), dv.y(), corner.y());
  cv::Mat smooth = source;
  if (shrink > 1.2) cv::GaussianBlur(source, smooth, {}, 0.5 * shrink);
  cv::Mat picture, inside;
  cv::warpAffine(smooth, picture, map, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  cv::warpAffine(mask, inside, map, size, cv::INTER_NEAREST | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT, 0);
  cv::Mat lab, real;
  picture.convertTo(real, CV_32FC3, 1.0 / 255);
  cv::cvtColor(real, lab, cv::COLOR_RGB2Lab);
  cv::GaussianBlur(lab, lab, {}, 1.5);
  cv::Mat core;
  cv::erode(inside, core, cv::getStructuringElement(cv::MORPH_ELLIPSE, {9, 9}), {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  if (coarse) cv::GaussianBlur(lab, lab, {}, 4);
  std::vector<cv::Mat> channels;
  cv::split(lab, channels);
  Field field;
  std::vector<float> strength;
  for (const cv::Mat& channel : channels) {
    cv::Mat gx, gy;
    cv::Scharr(channel, gx, CV_32F, 1, 0, 1.0 / 32);
    cv::Scharr(channel, gy, CV_32F, 0, 1, 1.0 / 32);
    gx.setTo(0, core == 0);
    gy.setTo(0, core == 0);
    field.gx.push_back(gx);
    field.gy.push_back(gy);
  }
  for (int y = 0; y < size.height; y += 2)
    for (int x = 0; x < size.width; x += 2)
      if (core.at<uchar>(y, x))
        strength.push_back(std::hypot(field.gx[0].at<float>(y, x), field.gy[0].at<float>(y, x)));
  if (!strength.empty()) {
    const auto middle = strength.begin() + static_cast<std::ptrdiff_t>(strength.size() / 2);
    std::nth_element(strength.begin(), middle, strength.end());
    field.noise = 2.0 * *middle + 0.25;
  }
  return field;
}

/// Signed response across the curve at uv: dot of the gradient with the normal, squashed to -1..1.
double response(const Field& field, int channel, const Vec2& uv, const Vec2& normal) {
  const cv::Point2d c = cell(uv);
  const int x = static_cast<int>(std::lround(c.x)), y = static_cast<int>(std::lround(c.y));
  const cv::Mat& gx = field.gx[channel];
  if (x < 0 || y < 0 || x >= gx.cols || y >= gx.rows) return 0;
  const double g = gx.at<float>(y, x) * normal.x() + field.gy[channel].at<float>(y, x) * normal.y();
  return g / (std::abs(g) + field.noise);
}

struct Curve {
  std::vector<Vec2> at, normal;  // normal points away from the neck
};

Curve with_normals(std::vector<Vec2> points) {
  Curve curve;
  const int n = static_cast<int>(points.size());
  for (int i = 0; i < n; ++i) {
    const Vec2 t = (points[std::min(i + 1, n - 1)] - points[std::max(i - 1, 0)]).normalized();
    curve.normal.emplace_back(-t.y(), t.x());
  }
  curve.at = std::move(points);
  return curve;
}

/// Points at equal arc along a dense polyline.
std::vector<Vec2> resampled(const std::vector<Vec2>& line, int count) {
  std::vector<double> arc(line.size(), 0);
  for (std::size_t i = 1; i < line.size(); ++i) arc[i] = arc[i - 1] + (line[i] - line[i - 1]).norm();
  std::vector<Vec2> result;
  std::size_t k = 0;
  for (int i = 0; i < count; ++i) {
    const double target = arc.back() * i / (count - 1);
    while (k + 2 < line.size() && arc[k + 1] < target) ++k;
    const double length = arc[k + 1] - arc[k];
    const double t = length > 0 ? std::clamp((target - arc[k]) / length, 0.0, 1.0) : 0;
    result.push_back(line[k] + t * (line[k + 1] - line[k]));
  }
  return result;
}

/// Superellipse family: a = b = 1 is a V, 2 a half ellipse, larger ever squarer; `skew` moves the lowest point.
std::vector<Vec2> family(double a, double b, double depth, double skew) {
  std::vector<Vec2> line;
  for (int i = 0; i <= 120; ++i) {
    const double t = -std::cos(std::numbers::pi * i / 120);
    const double v = std::pow(std::max(0.0, 1 - std::pow(std::abs(t), a)), 1 / b);
    line.emplace_back(0.5 + 0.5 * t + skew * v * (1 - t * t), depth * v);
  }
  return line;
}

std::vector<Vec2> profile_line(const NecklineTemplate& shape, double depth, double skew) {
  std::vector<Vec2> line;
  for (const Vec2& p : shape.profile) {
    const double t = 2 * p.x() - 1;
    line.emplace_back(p.x() + skew * p.y() * (1 - t * t), depth * p.y());
  }
  return line;
}

double evidence_of(const Field& field, const Curve& curve) {
  double best = 0;
  for (int channel = 0; channel < 3; ++channel) {
    double up = 0, down = 0;
    int hits_up = 0, hits_down = 0, n = 0;
    for (std::size_t i = 2; i + 2 < curve.at.size(); ++i) {
      double high = 0, low = 0;
      for (const double offset : {-0.0125, 0.0, 0.0125}) {
        const double r = response(field, channel, curve.at[i] + offset * curve.normal[i], curve.normal[i]);
        high = std::max(high, r);
        low = std::min(low, r);
      }
      up += high;
      down -= low;
      hits_up += high > 0.35;
      hits_down += low < -0.35;
      ++n;
    }
    if (n == 0) continue;
    best = std::max({best, 0.5 * (up + hits_up) / n, 0.5 * (down + hits_down) / n});
  }
  return best;
}

/// Moves the curve onto the edge, each sample along its normal, neighbours together (shortest path over offsets).
std::vector<Vec2> snapped(const Field& field, const Curve& curve) {
  constexpr int kReach = 10;
  constexpr double kStep = 0.00625, kBend = 0.06;
  const int n = static_cast<int>(curve.at.size()), m = 2 * kReach + 1;
  // The polarity that the whole curve agrees on counts; an edge of the other one is another edge.
  int channel = 0;
  double sign = 1, strongest = -1;
  for (int c = 0; c < 3; ++c) {
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += response(field, c, curve.at[i], curve.normal[i]);
    if (std::abs(sum) > strongest) {
      strongest = std::abs(sum);
      channel = c;
      sign = sum < 0 ? -1 : 1;
    }
  }
  std::vector<std::vector<double>> cost(n, std::vector<double>(m, 1e18));
  std::vector<std::vector<int>> from(n, std::vector<int>(m, kReach));
  cost[0][kReach] = 0;
  for (int i = 1; i < n; ++i)
    for (int k = 0; k < m; ++k) {
      const double offset = (k - kReach) * kStep;
      const double r = sign * response(field, channel, curve.at[i] + offset * curve.normal[i], curve.normal[i]);
      const double own = -std::max(0.0, r) + 0.2 * std::pow(static_cast<double>(k - kReach) / kReach, 2);
      for (int j = std::max(0, k - 2); j <= std::min(m - 1, k + 2); ++j) {
        const double c = cost[i - 1][j] + own + kBend * (k - j) * (k - j);
        if (c < cost[i][k]) {
          cost[i][k] = c;
          from[i][k] = j;
        }
      }
    }
  std::vector<double> offset(n, 0);
  int k = kReach;
  for (int i = n - 1; i >= 0; --i) {
    offset[i] = (k - kReach) * kStep;
    k = from[i][k];
  }
  std::vector<Vec2> result(n);
  for (int i = 0; i < n; ++i) {
    double sum = 0, weight = 0;
    for (int d = -2; d <= 2; ++d) {
      const int j = std::clamp(i + d, 0, n - 1);
      sum += (3 - std::abs(d)) * offset[j];
      weight += 3 - std::abs(d);
    }
    result[i] = curve.at[i] + (i == 0 || i == n - 1 ? 0.0 : sum / weight) * curve.normal[i];
  }
  return result;
}

}  // namespace

NeckPath find_front_neckline(const Image& rgb, const cv::Mat& mask, const std::vector<Vec2>& top,
                             const NecklineTemplate* shape) {
  NeckPath result;
  if (top.size() < 8) return result;
  NeckFrame frame{top.front(), top.back() - top.front(), Vec2::Zero()};
  if (frame.along.norm() < 16) return result;
  frame.down = Vec2(-frame.along.y(), frame.along.x());
  double top_depth = 0;
  for (const Vec2& p : top) top_depth = std::max(top_depth, frame.uv(p).y());
  result.expected_none = top_depth >= kDeepTop;
  const Field fine = gradient_field(rgb, mask, frame, false);
  // Stripes and ribs are edges everywhere; their mean tells the trim of the neckline from the cloth.
  const Field coarse = gradient_field(rgb, mask, frame, true);
  const Field* best_field = &fine;
  Curve best;
  const auto consider = [&](std::vector<Vec2> line, double prior) {
    Curve curve = with_normals(resampled(line, kCurve));
    const double sharp = prior * evidence_of(fine, curve), broad = 0.97 * prior * evidence_of(coarse, curve);
    if (std::max(sharp, broad) <= result.evidence) return;
    result.evidence = std::max(sharp, broad);
    best_field = sharp >= broad ? &fine : &coarse;
    best = std::move(curve);
  };
  for (double depth = top_depth + kBelowTop; depth < 1.5; depth += 0.02) {
    const double below = depth - top_depth;
    // The lower edge of the back's own collar band (2-3 cm on a neck of 20) is no front neckline.
    const double prior = (depth > 1.2 ? 0.95 : 1.0) * (0.8 + 0.15 * std::clamp((below - 0.13) / 0.09, 0.0, 1.0) +
                                                       0.05 * std::clamp((below - 0.2) / 0.15, 0.0, 1.0));
    for (const double skew : {-0.08, -0.04, 0.0, 0.04, 0.08}) {
      if (shape) {
        consider(profile_line(*shape, depth, skew), prior);
        continue;
      }
      for (const double a : {1.0, 1.4, 2.0, 3.0})
        for (const double b : {1.0, 1.4, 2.0, 3.0})
          if (std::abs(a - b) < 1.1) consider(family(a, b, depth, skew), prior * (a * b > 6.5 ? 0.95 : 1.0));
    }
  }
  if (result.evidence < (top_depth < kDeepTop ? kMinEvidence : kMinEvidenceDeep)) return result;
  result.found = true;
  for (const Vec2& uv : snapped(*best_field, best)) result.path.push_back(frame.pixel(uv));
  return result;
}

}  // namespace vitrine::features_detail
