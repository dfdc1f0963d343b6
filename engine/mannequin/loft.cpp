// SPDX-License-Identifier: GPL-3.0-or-later
#include "loft.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vitrine::body {

namespace {

constexpr std::array<double Section::*, 7> parameters{
    &Section::x, &Section::z, &Section::a, &Section::front, &Section::back, &Section::n_front, &Section::n_back};

std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  std::vector<double> slope(n, 0.0);
  if (n < 2) return slope;
  std::vector<double> secant(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) secant[i] = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
  slope.front() = secant.front();
  slope.back() = secant.back();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (secant[i - 1] * secant[i] <= 0) continue;
    const double h0 = x[i] - x[i - 1], h1 = x[i + 1] - x[i];
    slope[i] = (h0 + h1) * 3 / ((2 * h1 + h0) / secant[i - 1] + (h1 + 2 * h0) / secant[i]);
  }
  return slope;
}

double hermite(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& slope,
               double at) {
  if (at <= x.front()) return y.front();
  if (at >= x.back()) return y.back();
  const std::size_t i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin()) - 1;
  const double h = x[i + 1] - x[i], t = (at - x[i]) / h;
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * y[i] + (t3 - 2 * t2 + t) * h * slope[i] + (-2 * t3 + 3 * t2) * y[i + 1] +
         (t3 - t2) * h * slope[i + 1];
}

}  // namespace

double monotone_cubic(const std::vector<double>& x, const std::vector<double>& y, double at) {
  return hermite(x, y, monotone_slopes(x, y), at);
}

double section_girth(double a, double front, double back, double n_front, double n_back) {
  constexpr int steps = 48;
  double total = 0;
  for (int half = 0; half < 2; ++half) {
    const double b = half == 0 ? front : back, n = half == 0 ? n_front : n_back;
    double px = a, pz = 0;
    for (int i = 1; i <= steps; ++i) {
      const double angle = 0.5 * std::numbers::pi * i / steps;
      const double x = a * std::pow(std::max(std::cos(angle), 0.0), 2 / n), z = b * std::pow(std::sin(angle), 2 / n);
      total += 2 * std::hypot(x - px, z - pz);
      px = x;
      pz = z;
    }
  }
  return total;
}

Loft::Loft(const std::vector<Section>& sections, const Vec3& origin, const Vec3& along, const Vec3& across,
           const Vec3& forward, double smoothing, double rounding)
    : rounding_(rounding), origin_(origin), along_(along), across_(across), forward_(forward) {
  start_ = sections.front().s;
  end_ = sections.back().s;
  const int count = std::max(2, static_cast<int>(std::ceil((end_ - start_) / step_)) + 1);
  step_ = (end_ - start_) / (count - 1);
  table_.resize(static_cast<std::size_t>(count));
  std::vector<double> s, value(static_cast<std::size_t>(count));
  for (const Section& section : sections) s.push_back(section.s);
  for (double Section::*parameter : parameters) {
    std::vector<double> y;
    for (const Section& section : sections) y.push_back(section.*parameter);
    const std::vector<double> slope = monotone_slopes(s, y);
    for (int i = 0; i < count; ++i) value[i] = hermite(s, y, slope, start_ + step_ * i);
    // Three passes of a running mean come close to a Gaussian: a monotone cubic alone has jumps of curvature that a
    // glossy surface shows. The ends reflect at the end value, so they stay where they were put.
    const int half = static_cast<int>(smoothing / step_);
    for (int pass = 0; pass < 3 && half > 0; ++pass) {
      const std::vector<double> before = value;
      for (int i = 0; i < count; ++i) {
        double sum = 0;
        for (int j = i - half; j <= i + half; ++j) {
          const int inside = std::clamp(j, 0, count - 1);
          sum += j == inside ? before[j] : 2 * before[inside] - before[std::clamp(2 * inside - j, 0, count - 1)];
        }
        value[i] = sum / (2 * half + 1);
      }
    }
    for (int i = 0; i < count; ++i) table_[i].*parameter = value[i];
  }
  elliptic_ = std::all_of(sections.begin(), sections.end(),
                          [](const Section& section) { return section.n_front == 2 && section.n_back == 2; });
  low_ = Vec3::Constant(1e9);
  high_ = -low_;
  for (int i = 0; i < count; ++i) {
    Section& t = table_[i];
    t.s = start_ + step_ * i;
    t.a = std::max(t.a, 1e-3);
    t.front = std::max(t.front, 1e-3);
    t.back = std::max(t.back, 1e-3);
    const Vec3 centre = origin_ + t.s * along_ + t.x * across_ + t.z * forward_;
    const Vec3 reach = (t.a * across_).cwiseAbs() + (std::max(t.front, t.back) * forward_).cwiseAbs();
    low_ = low_.cwiseMin(centre - reach);
    high_ = high_.cwiseMax(centre + reach);
  }
}

Section Loft::at(double s) const {
  const double position = std::clamp((s - start_) / step_, 0.0, static_cast<double>(table_.size() - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(position), table_.size() - 2);
  const double f = position - static_cast<double>(i);
  Section result;
  result.s = s;
  for (double Section::*parameter : parameters)
    result.*parameter = (1 - f) * (table_[i].*parameter) + f * (table_[i + 1].*parameter);
  return result;
}

double Loft::distance(const Vec3& p) const {
  const Vec3 q = p - origin_;
  const double s = q.dot(along_);
  const double position = std::clamp((s - start_) / step_, 0.0, static_cast<double>(table_.size() - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(position), table_.size() - 2);
  const double f = position - static_cast<double>(i);
  const Section &A = table_[i], &B = table_[i + 1];
  const auto mix = [f](double from, double to) { return from + f * (to - from); };
  const double dx = q.dot(across_) - mix(A.x, B.x), dz = q.dot(forward_) - mix(A.z, B.z);
  const bool is_front = dz > 0;
  const double a = mix(A.a, B.a), b = is_front ? mix(A.front, B.front) : mix(A.back, B.back);
  const double n = is_front ? mix(A.n_front, B.n_front) : mix(A.n_back, B.n_back);
  const double u = std::abs(dx) / a, v = std::abs(dz) / b;
  double d = -std::min(a, b);
  if (u + v > 1e-4) {
    const double un = elliptic_ ? u * u : std::pow(u, n), vn = elliptic_ ? v * v : std::pow(v, n);
    const double g = elliptic_ ? std::sqrt(un + vn) : std::pow(un + vn, 1 / n);
    const double gu = u > 1e-9 ? un / u * g / (un + vn) : 0, gv = v > 1e-9 ? vn / v * g / (un + vn) : 0;
    const double gx = gu / a * (dx < 0 ? -1 : 1), gz = gv / b * (dz < 0 ? -1 : 1);
    // Beyond the ends the end's own slope stays in use: a jump of the divisor would show as a ring.
    const double da = (B.a - A.a) / step_, db = is_front ? (B.front - A.front) / step_ : (B.back - A.back) / step_;
    const double gs = -gx * (B.x - A.x) / step_ - gz * (B.z - A.z) / step_ - gu * u * da / a - gv * v * db / b;
    d = (g - 1) / std::sqrt(gx * gx + gz * gz + gs * gs);
  }
  const double e = std::max(s - end_, start_ - s) + rounding_, r = d + rounding_;
  return std::min(std::max(r, e), 0.0) + std::hypot(std::max(r, 0.0), std::max(e, 0.0)) - rounding_;
}

}  // namespace vitrine::body
