// SPDX-License-Identifier: GPL-3.0-or-later
#include "neckline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "vitrine/colour.hpp"

namespace vitrine::features_detail {
namespace {

// The search runs in the neck's own frame: u along the line between the neck points (0..1), v towards the hem in the
// same unit, `kUnit` pixels to a unit.
constexpr int kUnit = 96;
constexpr double kMarginU = 0.1, kMarginV = 0.25, kReachV = 1.75;
constexpr int kCurve = 48;  // samples along a curve
// Normals of the curves in steps of 15 degrees over the half circle away from the neck.
constexpr int kTurns = 12;
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

struct Curve {
  std::vector<Vec2> at, normal;  // normal points away from the neck
};

/// Gradient of the garment in the neck frame, zero where the neighbourhood leaves the garment.
struct Field {
  std::vector<cv::Mat> gx, gy;  // CV_32F, one per Lab channel
  float noise = 1;
  cv::Size size;
  /// For each direction of the normal and each cell what an edge there speaks for a curve: six bytes, rising and
  /// falling in L, a, b. Filled once, so that thousands of curves are read off it.
  std::vector<std::uint64_t> votes;
};

cv::Point cell(const Vec2& uv) {
  return {static_cast<int>((uv.x() + kMarginU) * kUnit + 0.5), static_cast<int>((uv.y() + kMarginV) * kUnit + 0.5)};
}

struct Crop {
  cv::Mat lab, core;  // CV_32FC3; CV_8U where the neighbourhood is garment
};

/// The neck's surroundings in its own frame. A large photo is brought to the frame's resolution first, so that it does
/// not alias.
Crop crop_neck(const Image& rgb, const cv::Mat& mask, const NeckFrame& frame) {
  const cv::Size size(static_cast<int>((1 + 2 * kMarginU) * kUnit), static_cast<int>((kMarginV + kReachV) * kUnit));
  cv::Mat source(rgb.height, rgb.width, CV_8UC3, const_cast<std::uint8_t*>(rgb.data.data()));
  Vec2 corner = frame.pixel({-kMarginU, -kMarginV});
  Vec2 du = frame.along / kUnit, dv = frame.down / kUnit;
  const auto map = [&] { return cv::Mat_<double>({2, 3}, {du.x(), dv.x(), corner.x(), du.y(), dv.y(), corner.y()}); };
  Crop crop;
  cv::Mat picture, inside;
  cv::warpAffine(mask, inside, map(), size, cv::INTER_NEAREST | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT, 0);
  const double shrink = du.norm();
  if (shrink > 1.2) {
    cv::Rect box(cv::Point(source.cols, source.rows), cv::Point(0, 0));
    Vec2 low = corner, high = corner;
    for (const Vec2& p : {Vec2(corner + size.width * du), Vec2(corner + size.height * dv),
                          Vec2(corner + size.width * du + size.height * dv)}) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    box = cv::Rect(cv::Point(static_cast<int>(low.x()) - 2, static_cast<int>(low.y()) - 2),
                   cv::Point(static_cast<int>(high.x()) + 3, static_cast<int>(high.y()) + 3)) &
          cv::Rect(0, 0, source.cols, source.rows);
    cv::Mat small;
    const cv::Size wanted(std::max(1, static_cast<int>(box.width / shrink)),
                          std::max(1, static_cast<int>(box.height / shrink)));
    cv::resize(source(box), small, wanted, 0, 0, cv::INTER_AREA);
    const double fx = static_cast<double>(wanted.width) / box.width,
                 fy = static_cast<double>(wanted.height) / box.height;
    corner = {(corner.x() - box.x + 0.5) * fx - 0.5, (corner.y() - box.y + 0.5) * fy - 0.5};
    du = {du.x() * fx, du.y() * fy};
    dv = {dv.x() * fx, dv.y() * fy};
    source = small;
  }
  cv::warpAffine(source, picture, map(), size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  crop.lab.create(picture.size(), CV_32FC3);
  lab_from_srgb(picture.ptr(), crop.lab.ptr<float>(), picture.total());
  cv::GaussianBlur(crop.lab, crop.lab, {}, 0.9);
  cv::erode(inside, crop.core, cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5}), {-1, -1}, 1, cv::BORDER_CONSTANT,
            0);
  return crop;
}

Field gradient_field(const Crop& crop, bool coarse) {
  cv::Mat lab = crop.lab;
  if (coarse) cv::GaussianBlur(crop.lab, lab, {}, 2.4);
  std::vector<cv::Mat> channels;
  cv::split(lab, channels);
  Field field;
  field.size = lab.size();
  for (const cv::Mat& channel : channels) {
    cv::Mat gx, gy;
    cv::Scharr(channel, gx, CV_32F, 1, 0, 1.0 / 32);
    cv::Scharr(channel, gy, CV_32F, 0, 1, 1.0 / 32);
    gx.setTo(0, crop.core == 0);
    gy.setTo(0, crop.core == 0);
    field.gx.push_back(gx);
    field.gy.push_back(gy);
  }
  std::vector<float> strength;
  for (int y = 0; y < lab.rows; y += 2)
    for (int x = 0; x < lab.cols; x += 2)
      if (crop.core.at<uchar>(y, x))
        strength.push_back(std::hypot(field.gx[0].at<float>(y, x), field.gy[0].at<float>(y, x)));
  if (!strength.empty()) {
    const auto middle = strength.begin() + static_cast<std::ptrdiff_t>(strength.size() / 2);
    std::nth_element(strength.begin(), middle, strength.end());
    field.noise = 2 * *middle + 0.4F;
  }
  return field;
}

/// Half how clear an edge is, half whether it is one, in 0..255; `response` in -1..1.
std::uint8_t vote_of(float response) {
  return static_cast<std::uint8_t>(127.5F * std::max(0.0F, response) + (response > 0.35F ? 127.5F : 0.0F));
}

void fill_votes(Field& field) {
  const int w = field.size.width, h = field.size.height;
  const std::size_t cells = static_cast<std::size_t>(w) * h;
  field.votes.assign(cells * kTurns, 0);
  std::vector<float> response(cells);
  for (int turn = 0; turn < kTurns; ++turn) {
    const double angle = std::numbers::pi * turn / kTurns;
    const auto nx = static_cast<float>(std::cos(angle)), ny = static_cast<float>(std::sin(angle));
    // A cell to both sides: the family is not the neckline itself.
    const int step = static_cast<int>(std::lround(ny)) * w + static_cast<int>(std::lround(nx));
    std::uint64_t* const votes = field.votes.data() + cells * turn;
    for (int channel = 0; channel < 3; ++channel) {
      const float* const gx = field.gx[channel].ptr<float>();
      const float* const gy = field.gy[channel].ptr<float>();
      for (std::size_t i = 0; i < cells; ++i) {
        const float g = gx[i] * nx + gy[i] * ny;
        response[i] = g / (std::abs(g) + field.noise);
      }
      for (int y = 1; y + 1 < h; ++y)
        for (int x = 1; x + 1 < w; ++x) {
          const int i = y * w + x;
          const float a = response[i - step], b = response[i], c = response[i + step];
          const float high = std::max(a, std::max(b, c)), low = std::min(a, std::min(b, c));
          votes[i] |= static_cast<std::uint64_t>(vote_of(high)) << (16 * channel) |
                      static_cast<std::uint64_t>(vote_of(-low)) << (16 * channel + 8);
        }
    }
  }
}

/// Signed response across the curve at uv: dot of the gradient with the normal, squashed to -1..1.
double response(const Field& field, int channel, const Vec2& uv, const Vec2& normal) {
  const cv::Point c = cell(uv);
  if (c.x < 0 || c.y < 0 || c.x >= field.size.width || c.y >= field.size.height) return 0;
  const double g = field.gx[channel].at<float>(c) * normal.x() + field.gy[channel].at<float>(c) * normal.y();
  return g / (std::abs(g) + field.noise);
}

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
  result.reserve(count);
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

struct Shape {
  std::vector<Vec2> line;  // s 0..1, depth 0..1
  double prior = 1;
};

/// Superellipse family: a = b = 1 is a V, 2 a half ellipse, larger ever squarer.
Shape superellipse(double a, double b, double prior) {
  Shape shape{{}, prior};
  for (int i = 0; i <= 64; ++i) {
    const double t = -std::cos(std::numbers::pi * i / 64);
    shape.line.emplace_back(0.5 + 0.5 * t, std::pow(std::max(0.0, 1 - std::pow(std::abs(t), a)), 1 / b));
  }
  return shape;
}

/// A square neck as it is sewn: sides that lean by `lean` of half the width, round corners.
Shape square(double lean, double prior) {
  constexpr double kRound = 0.12;
  const double corner = 0.5 * (1 - lean);
  std::vector<Vec2> half = {{0.5, 0}, {0.5 - 0.5 * lean * (1 - kRound), 1 - kRound}};
  const Vec2 from = half.back(), to(corner - kRound, 1), tip(corner, 1);
  for (int i = 1; i <= 6; ++i) {
    const double t = i / 6.0;
    half.push_back((1 - t) * (1 - t) * from + 2 * t * (1 - t) * tip + t * t * to);
  }
  Shape shape{{}, prior};
  for (const Vec2& p : half) shape.line.emplace_back(0.5 - p.x(), p.y());
  for (auto p = half.rbegin(); p != half.rend(); ++p) shape.line.emplace_back(0.5 + p->x(), p->y());
  return shape;
}

std::vector<Shape> shapes_for(const NecklineTemplate* named) {
  if (named) return {Shape{named->profile, 1}};
  std::vector<Shape> shapes;
  for (const double a : {1.0, 1.4, 2.0, 3.0})
    for (const double b : {1.0, 1.4, 2.0, 3.0})
      if (std::abs(a - b) < 1.1) shapes.push_back(superellipse(a, b, a * b > 6.5 ? 0.95 : 1.0));
  for (const double lean : {0.04, 0.14}) shapes.push_back(square(lean, 0.95));
  return shapes;
}

/// The shape on the neck, its lowest point moved by `skew`.
std::vector<Vec2> laid(const Shape& shape, double depth, double skew) {
  std::vector<Vec2> line;
  line.reserve(shape.line.size());
  for (const Vec2& p : shape.line) {
    const double t = 2 * p.x() - 1;
    line.emplace_back(p.x() + skew * p.y() * (1 - t * t), depth * p.y());
  }
  return line;
}

/// Where a curve reads the votes of a field.
struct Reading {
  std::size_t at = 0;
  bool swapped = false;  ///< its normal is in the other half circle: rising and falling change places
};

std::vector<Reading> readings_of(const Curve& curve, const cv::Size& size) {
  std::vector<Reading> readings;
  readings.reserve(curve.at.size());
  for (std::size_t i = 1; i + 1 < curve.at.size(); ++i) {
    const cv::Point c = cell(curve.at[i]);
    if (c.x < 0 || c.y < 0 || c.x >= size.width || c.y >= size.height) continue;
    const Vec2& normal = curve.normal[i];
    const int turn = static_cast<int>(std::lround(std::atan2(normal.y(), normal.x()) * kTurns / std::numbers::pi));
    const std::size_t plane = static_cast<std::size_t>((turn + kTurns) % kTurns) * size.area();
    readings.push_back({plane + static_cast<std::size_t>(c.y) * size.width + c.x, turn < 0 || turn >= kTurns});
  }
  return readings;
}

/// Share of the curve (0..1) that lies on an edge of one polarity in one channel.
double evidence_of(const Field& field, const std::vector<Reading>& readings) {
  constexpr std::uint64_t kEven = 0x00FF00FF00FF00FFULL;
  std::uint64_t rising = 0, falling = 0;  // sums in lanes of 16 bits, a lane per channel
  for (const Reading& reading : readings) {
    const std::uint64_t votes = field.votes[reading.at];
    (reading.swapped ? falling : rising) += votes & kEven;
    (reading.swapped ? rising : falling) += (votes >> 8) & kEven;
  }
  double best = 0;
  for (int channel = 0; channel < 3; ++channel)
    for (const std::uint64_t sum : {rising, falling})
      best = std::max(best, static_cast<double>((sum >> (16 * channel)) & 0xFFFF));
  return best / (255.0 * (kCurve - 2));
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
                             const NecklineTemplate* named) {
  NeckPath result;
  if (top.size() < 8) return result;
  NeckFrame frame{top.front(), top.back() - top.front(), Vec2::Zero()};
  if (frame.along.norm() < 16) return result;
  frame.down = Vec2(-frame.along.y(), frame.along.x());
  double top_depth = 0;
  for (const Vec2& p : top) top_depth = std::max(top_depth, frame.uv(p).y());
  result.expected_none = top_depth >= kDeepTop;
  const Crop crop = crop_neck(rgb, mask, frame);
  Field fine = gradient_field(crop, false);
  // Stripes and ribs are edges everywhere; their mean tells the trim of the neckline from the cloth.
  Field coarse = gradient_field(crop, true);
  fill_votes(fine);
  fill_votes(coarse);
  const Field* best_field = &fine;
  Curve best;
  const std::vector<Shape> shapes = shapes_for(named);
  for (double depth = top_depth + kBelowTop; depth < 1.5; depth += 0.02) {
    const double below = depth - top_depth;
    // The lower edge of the back's own collar band (2-3 cm on a neck of 20) is no front neckline.
    const double likely = (depth > 1.2 ? 0.95 : 1.0) * (0.8 + 0.15 * std::clamp((below - 0.13) / 0.09, 0.0, 1.0) +
                                                        0.05 * std::clamp((below - 0.2) / 0.15, 0.0, 1.0));
    for (const double skew : {-0.08, -0.04, 0.0, 0.04, 0.08})
      for (const Shape& shape : shapes) {
        Curve curve = with_normals(resampled(laid(shape, depth, skew), kCurve));
        const double prior = likely * shape.prior;
        const std::vector<Reading> readings = readings_of(curve, fine.size);
        const double sharp = prior * evidence_of(fine, readings), broad = 0.97 * prior * evidence_of(coarse, readings);
        if (std::max(sharp, broad) <= result.evidence) continue;
        result.evidence = std::max(sharp, broad);
        best_field = sharp >= broad ? &fine : &coarse;
        best = std::move(curve);
      }
  }
  if (result.evidence < (top_depth < kDeepTop ? kMinEvidence : kMinEvidenceDeep)) return result;
  result.found = true;
  for (const Vec2& uv : snapped(*best_field, best)) result.path.push_back(frame.pixel(uv));
  return result;
}

}  // namespace vitrine::features_detail
