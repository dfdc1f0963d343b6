// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "noise.hpp"
#include "photo_parts.hpp"

namespace vitrine::support {
namespace {

/// One drawn-out fold: a ridge along a bent line that rises and dies away.
struct Fold {
  Vec2 from, by, to;
  double width, height;  // [cm]
};

void draw(const Fold& fold, const Canvas& canvas, const PhotoSpec& spec, Layers& layers) {
  Curve curve;
  double length = 0;
  for (int i = 0; i <= 24; ++i) {
    const double t = i / 24.0, s = 1 - t;
    curve.push_back(warp(s * s * fold.from + 2 * s * t * fold.by + t * t * fold.to, spec));
    if (i > 0) length += (curve[i] - curve[i - 1]).norm();
  }
  paint_near(curve, 2.6 * fold.width, canvas, [&](int x, int y, double d, double along, bool left) {
    // One flank is steeper than the other: cloth leans over its folds.
    const double w = fold.width * (left ? 0.7 : 1.3) * (0.6 + 0.8 * along / length);
    const double taper = std::pow(std::sin(std::numbers::pi * std::clamp(along / length, 0.0, 1.0)), 0.7);
    layers.relief(y, x) += static_cast<float>(fold.height * taper * std::exp(-d * d / (w * w)));
  });
}

std::vector<Fold> folds_of_top(const PhotoSpec& s, const Shape& shape, Dice& dice) {
  std::vector<Fold> folds;
  for (int i = 0; i < 2; ++i) {
    const double sign = i == 0 ? -1 : 1;
    const Vec2 armpit = shape.landmarks.at(i == 0 ? "armpit_left" : "armpit_right");
    for (int k = 0; k < 3; ++k) {  // from the armpits down to the middle
      const Vec2 from = armpit + Vec2(-sign * dice.range(0.6, 2), dice.range(-2.5, 2.5));
      const Vec2 to = from + Vec2(-sign * dice.range(5, 13), dice.range(3, 15));
      folds.push_back({from, (from + to) / 2 + Vec2(dice.range(-1, 1), dice.range(0, 3)), to, dice.range(0.5, 1.1),
                       dice.range(0.06, 0.16)});
    }
    for (int k = 0; k < 2; ++k) {  // pulled in at the waist
      const double y = s.length * dice.range(0.55, 0.85);
      const Vec2 from(sign * s.chest / 2 * 0.93, y), to(sign * dice.range(2, 10), y + dice.range(-7, 4));
      folds.push_back(
          {from, (from + to) / 2 + Vec2(0, dice.range(-2, 2)), to, dice.range(0.7, 1.5), dice.range(0.05, 0.12)});
    }
    if (has_sleeves(s.garment)) {
      const Vec2 upper = shape.landmarks.at(i == 0 ? "cuff_upper_left" : "cuff_upper_right");
      const Vec2 lower = shape.landmarks.at(i == 0 ? "cuff_lower_left" : "cuff_lower_right");
      const Vec2 shoulder = shape.landmarks.at(i == 0 ? "shoulder_left" : "shoulder_right");
      const auto at = [&](double along, double across) {  // across: 0 upper edge, 1 lower edge
        const Vec2 a = shoulder + along * (upper - shoulder), b = armpit + along * (lower - armpit);
        return Vec2(a + across * (b - a));
      };
      for (int k = 0; k < 2; ++k) {  // a sleeve laid down at the side is pushed together under its head
        const Vec2 from = armpit + Vec2(sign * dice.range(1, 2.5), -dice.range(0, 4));
        const Vec2 to = from + Vec2(sign * dice.range(2, 5), -dice.range(6, 11));
        folds.push_back({from, (from + to) / 2 + Vec2(sign * dice.range(0, 2), 0), to, dice.range(0.5, 1.0),
                         dice.range(0.06, 0.12)});
      }
      for (int k = 0; k < 4; ++k) {  // round the elbow
        const double t = dice.range(0.4, 0.75), lean = dice.range(-0.10, 0.10);
        folds.push_back({at(t, dice.range(0.05, 0.25)), at(t + 0.5 * lean + 0.02, 0.5),
                         at(t + lean, dice.range(0.7, 0.95)), dice.range(0.4, 0.8), dice.range(0.06, 0.12)});
      }
      for (int k = 0; k < 2; ++k)  // along the sleeve
        folds.push_back({at(dice.range(0.05, 0.15), dice.range(0.3, 0.6)), at(0.4, dice.range(0.35, 0.65)),
                         at(dice.range(0.6, 0.9), dice.range(0.3, 0.7)), dice.range(0.7, 1.3), dice.range(0.06, 0.14)});
    }
  }
  for (int k = 0; k < 2; ++k) {  // from the hem upwards
    const Vec2 from(dice.range(-0.35, 0.35) * s.hem, s.length - dice.range(0.5, 3));
    const Vec2 to = from + Vec2(dice.range(-5, 5), -dice.range(10, 20));
    folds.push_back(
        {from, (from + to) / 2 + Vec2(dice.range(-2, 2), 0), to, dice.range(0.9, 1.8), dice.range(0.06, 0.12)});
  }
  return folds;
}

std::vector<Fold> folds_of_skirt(const PhotoSpec& s, Dice& dice) {
  std::vector<Fold> folds;
  for (int i = 0; i < 2; ++i) {
    const double sign = i == 0 ? -1 : 1;
    for (int k = 0; k < 3; ++k) {  // tension across the hip
      const double y = s.hip_depth * dice.range(0.8, 1.5);
      const Vec2 from(sign * s.hip / 2 * 0.94, y), to(sign * dice.range(4, 12), y + dice.range(-5, 3));
      folds.push_back(
          {from, (from + to) / 2 + Vec2(0, dice.range(0, 2)), to, dice.range(0.5, 1.0), dice.range(0.05, 0.10)});
    }
    const Vec2 from(sign * dice.range(6, 12), s.waistband + 2),
        to(sign * dice.range(8, 16), s.length * dice.range(0.6, 0.9));
    folds.push_back(
        {from, (from + to) / 2 + Vec2(dice.range(-2, 2), 0), to, dice.range(0.8, 1.6), dice.range(0.06, 0.12)});
  }
  return folds;
}

}  // namespace

void add_relief(const PhotoSpec& spec, const Shape& shape, const Canvas& canvas, Layers& layers) {
  const std::uint32_t seed = spec.seed * 131 + (spec.side == Side::back ? 57 : 0);
  layers.relief = cv::Mat1f(canvas.height, canvas.width, 0.0f);
  // A little beyond the garment too, so that its border has a slope of its own and not that of a cliff.
  cv::Mat1f near_garment;
  cv::dilate(layers.total, near_garment, cv::Mat::ones(7, 7, CV_8U));
  // Hanging folds fan out from a point above the waist.
  const double widening = (spec.hem - spec.chest) / std::max(1.0, spec.length);
  const double apex = spec.chest / std::max(0.2, widening);
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x) {
      if (near_garment(y, x) <= 0) continue;
      const Vec2 p = canvas.cm(Vec2(x, y));
      double h = spec.creases * (0.40 * fractal_noise(p.x() / 11, p.y() / 14, 2, seed) +
                                 0.05 * fractal_noise(p.x() / 3.1, p.y() / 3.6, 3, seed + 9));
      if (spec.gathers > 0) {
        const double down = std::clamp((p.y() - spec.waistband) / (spec.length - spec.waistband), 0.0, 1.0);
        const double angle = p.x() / (p.y() + apex) * (spec.length + apex);  // [cm] measured at the hem
        const double wide = hanging_fold(angle, p.y(), down, spec);
        const double fine = noise(angle / 2.1, 0.6 * down, seed + 5);
        h += spec.gathers *
             (3.0 * std::pow(down, 0.8) * wide + (0.35 + 0.25 * (1 - down)) * std::min(1.0, 6 * down) * fine);
      }
      layers.relief(y, x) = static_cast<float>(h);
    }
  Dice dice(seed);
  if (spec.creases > 0) {
    const std::vector<Fold> folds =
        has_waist(spec.garment) ? folds_of_skirt(spec, dice) : folds_of_top(spec, shape, dice);
    for (Fold fold : folds) {
      fold.height *= 1.9 * spec.creases;
      draw(fold, canvas, spec, layers);
    }
  }
  // The cloth's own thickness rounds its border.
  const cv::Mat solid = layers.face > 0.5;
  cv::Mat distance;
  cv::distanceTransform(solid, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  cv::Mat1f rim(canvas.height, canvas.width);
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x)
      rim(y, x) = static_cast<float>(0.16 * (1 - std::exp(-distance.at<float>(y, x) / canvas.scale / 0.42)));
  cv::GaussianBlur(rim, rim, {0, 0}, 0.05 * canvas.scale + 0.3);
  layers.relief += rim;
}

}  // namespace vitrine::support
