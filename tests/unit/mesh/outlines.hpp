// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Panel outlines for the mesher: garments drawn in metres, and seeded random blobs. All counter-clockwise, their
// segments about `h` long.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "vitrine/model/geometry.hpp"

namespace vitrine::test {

using Outline = std::vector<Vec2>;

inline Outline bezier(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  Outline points;
  for (int i = 0; i <= 200; ++i) {
    const double t = i / 200.0, u = 1 - t;
    points.push_back(u * u * u * a + 3 * u * u * t * b + 3 * u * t * t * c + t * t * t * d);
  }
  return points;
}

/// Points at equal arc along the line, without its last; at least two segments.
inline Outline spaced(const Outline& line, double h) {
  std::vector<double> arc{0};
  for (std::size_t i = 1; i < line.size(); ++i) arc.push_back(arc.back() + (line[i] - line[i - 1]).norm());
  const int n = std::max(2, static_cast<int>(std::lround(arc.back() / h)));
  Outline points;
  std::size_t k = 1;
  for (int i = 0; i < n; ++i) {
    const double s = arc.back() * i / n;
    while (k + 1 < line.size() && arc[k] < s) ++k;
    points.push_back(line[k - 1] + (line[k] - line[k - 1]) * ((s - arc[k - 1]) / (arc[k] - arc[k - 1])));
  }
  return points;
}

inline Outline joined(const std::vector<Outline>& lines, double h) {
  Outline outline;
  for (const Outline& line : lines) {
    const Outline points = spaced(line, h);
    outline.insert(outline.end(), points.begin(), points.end());
  }
  return outline;
}

inline Vec2 mirrored(const Vec2& p) {
  return {-p.x(), p.y()};
}

/// The vest of the comparison with other meshers (0.30 m^2).
inline Outline vest(double h) {
  const Vec2 hem(.27, .85), armpit(.265, 1.24), shoulder(.185, 1.445), neck(.085, 1.48);
  return joined({{mirrored(hem), hem},
                 {hem, armpit},
                 bezier(armpit, {.21, 1.255}, {.172, 1.34}, shoulder),
                 {shoulder, neck},
                 bezier(neck, {.07, 1.375}, {-.07, 1.375}, mirrored(neck)),
                 {mirrored(neck), mirrored(shoulder)},
                 bezier(mirrored(shoulder), {-.172, 1.34}, {-.21, 1.255}, mirrored(armpit)),
                 {mirrored(armpit), mirrored(hem)}},
                h);
}

/// A deep V-neck between straps 4 cm wide.
inline Outline v_neck(double h) {
  const Vec2 hem(.22, 0), armpit(.24, .40), shoulder(.14, .62), neck(.10, .63), tip(0, .40);
  return joined({{mirrored(hem), hem},
                 {hem, armpit},
                 bezier(armpit, {.16, .42}, {.14, .5}, shoulder),
                 {shoulder, neck},
                 {neck, tip},
                 {tip, mirrored(neck)},
                 {mirrored(neck), mirrored(shoulder)},
                 bezier(mirrored(shoulder), {-.14, .5}, {-.16, .42}, mirrored(armpit)),
                 {mirrored(armpit), mirrored(hem)}},
                h);
}

/// A long-sleeved top with its sleeves spread, sharp concave armpits and cuffs 10 cm wide.
inline Outline sleeves(double h) {
  const Vec2 hem(.26, 0), armpit(.25, .40), lower(.80, .37), upper(.81, .47), shoulder(.20, .62), neck(.09, .66);
  return joined({{mirrored(hem), hem},
                 {hem, armpit},
                 {armpit, lower},
                 {lower, upper},
                 {upper, shoulder},
                 {shoulder, neck},
                 bezier(neck, {.06, .58}, {-.06, .58}, mirrored(neck)),
                 {mirrored(neck), mirrored(shoulder)},
                 {mirrored(shoulder), mirrored(upper)},
                 {mirrored(upper), mirrored(lower)},
                 {mirrored(lower), mirrored(armpit)},
                 {mirrored(armpit), mirrored(hem)}},
                h);
}

inline Outline skirt(double h) {
  return joined({bezier({-.45, .05}, {-.2, -.05}, {.2, -.05}, {.45, .05}),
                 {{.45, .05}, {.17, .6}},
                 bezier({.17, .6}, {.08, .58}, {-.08, .58}, {-.17, .6}),
                 {{-.17, .6}, {-.45, .05}}},
                h);
}

/// A belt 3 cm wide and 1 m long, lying askew.
inline Outline belt(double h) {
  return joined({{{0, 0}, {1, .1}}, {{1, .1}, {1, .13}}, {{1, .13}, {0, .03}}, {{0, .03}, {0, 0}}}, h);
}

/// The same numbers on every machine, unlike the standard library's distributions.
class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(seed * 2654435761u + 1u) {}
  double unit() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return state_ / 4294967296.0;
  }
  double between(double a, double b) { return a + (b - a) * unit(); }

 private:
  std::uint32_t state_;
};

/// A blob with bays and horns, about 0.6 m across.
inline Outline blob(std::uint32_t seed, double h) {
  Random random(seed);
  std::vector<double> wave;
  for (int k = 0; k < 10; ++k) wave.push_back(random.between(-0.14, 0.14));
  Outline line;
  for (int i = 0; i <= 600; ++i) {
    const double a = 2 * std::numbers::pi * i / 600;
    double r = 0.3;
    for (int k = 0; k < 5; ++k)
      r += 0.3 * (wave[2 * k] * std::cos((k + 1) * a) + wave[2 * k + 1] * std::sin((k + 1) * a));
    line.push_back({r * std::cos(a), r * std::sin(a)});
  }
  return joined({line}, h);
}

/// A polygon with straight sides and sharp corners of either turn, star-shaped about the origin.
inline Outline star(std::uint32_t seed, double h) {
  Random random(seed);
  const int corners = 5 + static_cast<int>(random.between(0, 8));
  std::vector<Vec2> corner;
  for (int i = 0; i < corners; ++i) {
    const double a = 2 * std::numbers::pi * (i + random.between(-0.25, 0.25)) / corners, r = random.between(0.15, 0.45);
    corner.push_back({r * std::cos(a), r * std::sin(a)});
  }
  std::vector<Outline> sides;
  for (int i = 0; i < corners; ++i) sides.push_back({corner[i], corner[(i + 1) % corners]});
  return joined(sides, h);
}

}  // namespace vitrine::test
