// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include "noise.hpp"
#include "photo_parts.hpp"

namespace vitrine::support {
namespace {

constexpr double step = 0.4;  // [cm] between points of a curve: finer than the bends that warp() puts in

void append(Curve& to, const Curve& more) {
  for (const Vec2& p : more)
    if (to.empty() || (to.back() - p).norm() > 1e-9) to.push_back(p);
}

Curve reversed(Curve curve) {
  std::reverse(curve.begin(), curve.end());
  return curve;
}

Curve bezier(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double length = (b - a).norm() + (c - b).norm() + (d - c).norm();
  const int n = std::max(2, static_cast<int>(length / step));
  Curve curve;
  for (int i = 0; i <= n; ++i) {
    const double t = static_cast<double>(i) / n, s = 1 - t;
    curve.push_back(s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d);
  }
  return curve;
}

Curve line(const Vec2& a, const Vec2& b) {
  return bezier(a, a + (b - a) / 3, b - (b - a) / 3, b);
}

/// A line that leans out by `bow`, to the left of its direction where positive.
Curve bowed(const Vec2& a, const Vec2& b, double bow) {
  const Vec2 d = b - a;
  const Vec2 n = Vec2(d.y(), -d.x()).normalized() * bow * 4 / 3;
  return bezier(a, a + d / 3 + n, b - d / 3 + n, b);
}

/// From the neck point (w, 0) down to the middle (0, depth).
Curve half_neck(NeckKind kind, double w, double depth) {
  if (kind == NeckKind::v) return bowed({w, 0}, {0, depth}, -0.02 * depth);
  if (kind == NeckKind::square) {
    const double r = std::min(1.2, depth * 0.3);
    Curve c = line({w, 0}, {0.93 * w, depth - r});
    append(c, bezier({0.93 * w, depth - r}, {0.925 * w, depth - 0.3 * r}, {0.92 * w - 0.3 * r, depth},
                     {0.92 * w - r, depth}));
    append(c, line({0.92 * w - r, depth}, {0, depth}));
    return c;
  }
  Curve c;
  const int n = static_cast<int>((w + depth) / step);
  if (kind == NeckKind::boat) {  // a shallow arc
    for (int i = 0; i <= n; ++i) {
      const double t = 1 - static_cast<double>(i) / n;
      c.emplace_back(w * t, depth * (1 - t * t));
    }
    return c;
  }
  for (int i = 0; i <= n; ++i) {
    const double t = i * std::numbers::pi / 2 / n;
    c.emplace_back(i == n ? 0 : w * std::pow(std::cos(t), 0.86), depth * std::pow(std::sin(t), 0.86));
  }
  return c;
}

struct Half {
  Vec2 waist = Vec2::Zero();  // of a dress
  // From the middle outwards, downwards. Of trousers `hem` is the whole lower edge, `cuff` the leg's opening in it.
  Curve top_front, top_back, shoulder, armhole, upper, cuff, under, side, hem;
};

/// A set-in sleeve laid down beside the body: its head swells out from the shoulder, from the armpit on it tapers.
void add_sleeve(Half& h, const PhotoSpec& s, const Vec2& shoulder, const Vec2& armpit, double turn) {
  const double a = (s.sleeve_angle + turn) * std::numbers::pi / 180;
  const Vec2 along(std::sin(a), std::cos(a)), outward(std::cos(a), -std::sin(a));
  // The cuff stands square to the sleeve, `sleeve_length` from the shoulder.
  const double down = (armpit - shoulder).dot(along), rise = (shoulder - armpit).dot(outward);
  const double cuff_rise = 0.5 * (s.sleeve_width + s.cuff_width) - rise;
  const double length = std::sqrt(s.sleeve_length * s.sleeve_length - cuff_rise * cuff_rise) - down;
  const int n = static_cast<int>(length / step);
  Curve upper;
  for (int i = 0; i <= n; ++i) {
    const double t = static_cast<double>(i) / n;
    // The upper arm's cloth narrows faster than the forearm's; both edges take half of it.
    const double width = s.sleeve_width + (s.cuff_width - s.sleeve_width) * (1.18 * t - 0.18 * t * t);
    const Vec2 middle = armpit + t * length * along + 0.5 * s.sleeve_width * outward;
    upper.push_back(middle + 0.5 * width * outward);
    // It leaves the body at an open angle: a gap that closes like a needle's eye would hide the armpit from the mask.
    const double from_armpit = t * length / 3;
    h.under.push_back(middle - (0.5 * width - 0.6 * from_armpit * std::exp(1 - from_armpit)) * outward);
  }
  h.under = reversed(h.under);
  const Vec2 out = (shoulder - Vec2(s.neck_half, 0)).normalized(), on = (upper[1] - upper[0]).normalized();
  const double head = (upper[0] - shoulder).norm();
  h.upper = bezier(shoulder, shoulder + 0.30 * head * out, upper[0] - 0.36 * head * on, upper[0]);
  append(h.upper, upper);
  h.cuff = line(upper.back(), h.under.front());
}

Half half_top(const PhotoSpec& s, double wide, double turn, double drop) {
  Half h;
  const bool sleeves = has_sleeves(s.garment);
  const Vec2 neck(s.neck_half, 0), shoulder(s.shoulder_half * wide, s.shoulder_drop);
  const Vec2 armpit(s.chest / 2 * wide, s.armhole_depth + 0.5 * drop);
  const Vec2 hem(s.hem / 2 * wide, s.length - s.hem_curve + drop);
  h.top_front = reversed(half_neck(s.neck, s.neck_half, s.neck_depth));
  h.top_back = reversed(half_neck(NeckKind::u, s.neck_half, s.back_neck_depth));
  h.shoulder = bowed(neck, shoulder, 0.15);
  const double d = armpit.y() - shoulder.y();
  h.armhole = sleeves ? bezier(shoulder, {shoulder.x() - 1.2, shoulder.y() + 0.45 * d},
                               {shoulder.x() - 0.6, shoulder.y() + 0.8 * d}, armpit)
                      : bezier(shoulder, {shoulder.x() - 1.0, shoulder.y() + 0.6 * d},
                               {shoulder.x() + 0.22 * (armpit.x() - shoulder.x()), shoulder.y() + 0.97 * d}, armpit);
  if (sleeves) add_sleeve(h, s, shoulder, armpit, turn);
  const double waist_y = armpit.y() + s.waist_level * (hem.y() - armpit.y());
  const double waist_x = s.waist_share * armpit.x();
  if (s.garment == GarmentKind::dress) {
    const Vec2 waist(waist_x, waist_y), hip(s.hip / 2 * wide, waist_y + s.hip_depth);
    h.side = bezier(armpit, armpit + Vec2(-0.2, 5), waist - Vec2(0, 5), waist);
    append(h.side, bezier(waist, waist + Vec2(0.1, 4), hip - 6 * (hem - waist).normalized(), hip));
    append(h.side, line(hip, hem));
    h.waist = waist;
  } else {
    h.side = bezier(armpit, {waist_x - 0.3, waist_y - 3}, {waist_x, waist_y + 8}, hem);
  }
  h.hem = bezier({0, s.length}, {hem.x() * 0.45, s.length}, {hem.x() * 0.8, s.length - 0.75 * s.hem_curve}, hem);
  return h;
}

void add_waist(Half& h, const PhotoSpec& s, const Vec2& waist) {
  h.top_front =
      reversed(bezier(waist, {waist.x() * 0.7, s.waist_dip * 0.9}, {waist.x() * 0.4, s.waist_dip}, {0, s.waist_dip}));
  h.top_back = reversed(bezier(waist, {waist.x() * 0.7, 0.05}, {waist.x() * 0.4, 0.1}, {0, 0.1}));
}

/// A leg whose inside runs straight from the crotch; its outside from the hip to the opening, which stands square to
/// the leg's middle line.
Half half_trousers(const PhotoSpec& s, double wide, double turn, double drop) {
  Half h;
  const double a = (s.leg_angle + std::max(-0.5 * s.leg_angle, 0.5 * turn)) * std::numbers::pi / 180;
  const Vec2 waist(s.chest / 2 * wide, 0), hip(s.hip / 2 * wide, s.hip_depth), crotch(0, s.rise);
  add_waist(h, s, waist);
  const double leg = (s.length - s.rise + drop) / std::cos(a);
  const Vec2 inside(std::sin(a), std::cos(a));
  // The narrowing is the outside's and the inside's by halves: the middle line turns outwards by half of it.
  const double taper = std::atan2(0.5 * (hip.x() - s.hem), leg);
  const Vec2 across(std::cos(a + taper), -std::sin(a + taper));
  const Vec2 inner = crotch + leg * inside, outer = inner + s.hem * wide * across;
  const Vec2 below(waist.x() + 0.35, s.waistband);
  h.side = line(waist, below);
  const Vec2 on = (outer - hip).normalized();
  append(h.side, bezier(below, {below.x() + 0.55 * (hip.x() - below.x()), below.y() + 0.3 * (hip.y() - below.y())},
                        hip - 0.4 * (hip.y() - below.y()) * on, hip));
  append(h.side, bowed(hip, outer, -0.01 * (outer - hip).norm()));
  // The seams of the two sides meet in a small bow.
  const Vec2 low = crotch + Vec2(0, s.touch);
  const double bow = s.touch > 0 ? 0 : std::min(2.0, 0.2 * (s.length - s.rise));
  const Vec2 start = low + bow / std::cos(a) * inside;
  if (bow > 0) h.under = bezier(low, low + Vec2(0.3 * start.x(), 0.1 * bow), start - 0.5 * bow * inside, start);
  append(h.under, line(start, inner));
  h.cuff = bowed(inner, outer, 0.15);
  h.hem = h.under;
  append(h.hem, h.cuff);
  return h;
}

Half half_skirt(const PhotoSpec& s, double wide, double drop) {
  Half h;
  const Vec2 waist(s.chest / 2 * wide, 0), hip(s.hip / 2 * wide, s.hip_depth);
  const Vec2 hem(s.hem / 2 * wide, s.length - s.hem_curve + drop);
  add_waist(h, s, waist);
  const Vec2 below(waist.x() + 0.35, s.waistband);  // the band itself stands straight
  h.side = line(waist, below);
  if (s.hem > s.hip * 1.2) {
    append(h.side, bowed(below, hem, 0.6));
  } else {
    append(h.side, bezier(below, {below.x() + 0.55 * (hip.x() - below.x()), below.y() + 0.3 * (hip.y() - below.y())},
                          {hip.x(), hip.y() - 0.45 * (hip.y() - below.y())}, hip));
    append(h.side, bezier(hip, hip + Vec2(0, 5), hem - Vec2(0, 5), hem));
  }
  h.hem = bezier({0, s.length}, {hem.x() * 0.45, s.length}, {hem.x() * 0.75, s.length - 0.5 * s.hem_curve}, hem);
  return h;
}

Curve turned(Curve curve, double sign) {
  for (Vec2& p : curve) p.x() *= sign;
  return curve;
}

/// The hem of a wide skirt rises and falls with its hanging folds; its corners stay.
void wave(Curve& hem, const PhotoSpec& s) {
  const double end = std::abs(hem.back().x());
  for (Vec2& p : hem) {
    const double fade = std::min(1.0, (end - std::abs(p.x())) / 6);
    p.y() += 0.9 * s.gathers * fade * hanging_fold(p.x(), p.y(), 1, s);
  }
}

}  // namespace

double hanging_fold(double at_hem, double y, double down, const PhotoSpec& s) {
  const std::uint32_t seed = s.seed * 131 + (s.side == Side::back ? 57 : 0);
  const double fall = 0.35 * noise(at_hem / 20, y / 22, seed + 3);
  return noise(at_hem / 5.2 + fall, 0.4 * down, seed + 4);
}

Vec2 warp(const Vec2& p, const PhotoSpec& s) {
  // Back and front are laid down separately.
  const std::uint32_t seed = s.seed * 7 + (s.side == Side::back ? 3 : 0);
  const double amount = 0.28 * s.creases * s.asymmetry;
  return p + amount * Vec2(noise(p.x() / 10, p.y() / 10, seed), noise(p.x() / 10, p.y() / 10, seed + 1)) +
         0.25 * amount * Vec2(noise(p.x() / 3, p.y() / 3, seed + 5), noise(p.x() / 3, p.y() / 3, seed + 6));
}

Shape make_shape(const PhotoSpec& s) {
  Dice dice(s.seed);
  std::array<double, 2> wide{}, turn{}, drop{};
  for (int i = 0; i < 2; ++i) {
    wide[i] = 1 + s.asymmetry * dice.range(-0.008, 0.008);
    turn[i] = s.asymmetry * dice.range(-1.5, 1.5);
    drop[i] = s.asymmetry * dice.range(-0.3, 0.3);
  }
  const bool hangs = has_waist(s.garment), legs = has_legs(s.garment), back = s.side == Side::back;
  std::array<Half, 2> half;
  for (int i = 0; i < 2; ++i) {
    const int own = back ? 1 - i : i;
    half[i] = legs    ? half_trousers(s, wide[own], turn[own], drop[own])
              : hangs ? half_skirt(s, wide[own], drop[own])
                      : half_top(s, wide[own], turn[own], drop[own]);
    const double sign = i == 0 ? -1 : 1;
    for (Curve Half::*part : {&Half::top_front, &Half::top_back, &Half::shoulder, &Half::armhole, &Half::upper,
                              &Half::cuff, &Half::under, &Half::side, &Half::hem}) {
      Curve& curve = half[i].*part;
      curve = turned(std::move(curve), sign);
      if (part == &Half::hem && s.gathers > 0) wave(curve, s);
      for (Vec2& p : curve) p = warp(p, s);
    }
    half[i].waist = warp(Vec2(sign * half[i].waist.x(), half[i].waist.y()), s);
  }
  const auto closed = [&](Curve Half::*top) {
    Curve outline;
    for (const int i : {1, 0}) {
      Curve run = half[i].*top;
      append(run, half[i].shoulder);
      if (has_sleeves(s.garment)) {
        append(run, half[i].upper);
        append(run, half[i].cuff);
        append(run, half[i].under);
      } else {
        append(run, half[i].armhole);
      }
      append(run, half[i].side);
      append(run, reversed(half[i].hem));
      append(outline, i == 1 ? run : reversed(run));
    }
    outline.pop_back();
    return outline;
  };
  const auto across = [&](Curve Half::*part) {
    Curve curve = reversed(half[0].*part);
    append(curve, half[1].*part);
    return curve;
  };
  Shape shape;
  shape.silhouette = closed(&Half::top_back);
  shape.face = back ? shape.silhouette : closed(&Half::top_front);
  shape.top_front = across(&Half::top_front);
  shape.top_back = across(&Half::top_back);
  shape.hem = across(&Half::hem);
  const Curve& top = back ? shape.top_back : shape.top_front;
  shape.landmarks[hangs ? "waist_low" : "neck_low"] =
      *std::max_element(top.begin(), top.end(), [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); });
  for (int i = 0; i < 2; ++i) {
    const Half& h = half[i];
    const std::string name = i == 0 ? "_left" : "_right";
    shape.cuff[i] = h.cuff;
    if (legs) {
      shape.landmarks["hem_outer" + name] = h.cuff.back();
      shape.landmarks["hem_inner" + name] = h.cuff.front();
      shape.landmarks["crotch"] = warp(Vec2(0, s.rise), s);
    } else {
      shape.landmarks["hem" + name] = h.side.back();
    }
    if (hangs) {
      shape.landmarks["waist" + name] = h.side.front();
      continue;
    }
    shape.landmarks["neck" + name] = h.shoulder.front();
    shape.landmarks["shoulder" + name] = h.shoulder.back();
    shape.landmarks["armpit" + name] = h.side.front();
    shape.shoulder[i] = h.shoulder;
    shape.armhole[i] = h.armhole;
    if (s.garment == GarmentKind::dress) shape.landmarks["waist" + name] = h.waist;
    if (has_sleeves(s.garment)) {
      shape.landmarks["cuff_upper" + name] = h.cuff.front();
      shape.landmarks["cuff_lower" + name] = h.cuff.back();
      shape.sleeve[i] = h.upper;
      append(shape.sleeve[i], h.cuff);
      append(shape.sleeve[i], h.under);
      append(shape.sleeve[i], reversed(h.armhole));
    }
  }
  return shape;
}

}  // namespace vitrine::support
