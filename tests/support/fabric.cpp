// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include "noise.hpp"
#include "photo_parts.hpp"

namespace vitrine::support {
namespace {

using std::numbers::pi;

/// Share of `second` in stripes of the given period; `soft` is half a pixel.
double stripe(double position, double period, double soft) {
  const double t = position - period * std::floor(position / period), wide = 0.42 * period;
  return std::min(smooth_step(-soft, soft, t), 1 - smooth_step(wide - soft, wide + soft, t)) +
         smooth_step(period - soft, period + soft, t);
}

void floral(const PhotoSpec& s, const Vec2& p, double soft, cv::Vec3f& colour) {
  const double cell = s.pattern;
  const int cx = static_cast<int>(std::floor(p.x() / cell)), cy = static_cast<int>(std::floor(p.y() / cell));
  const cv::Vec3f petal = linear(s.second), leaf = linear(s.third);
  for (int layer = 0; layer < 2; ++layer)  // all leaves lie under all flowers
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int ix = cx + dx, iy = cy + dy;
        const auto r = [&](std::uint32_t k) { return hash_unit(ix, iy, s.seed * 17 + k); };
        const Vec2 centre((ix + 0.5 + 0.28 * (r(1) - 0.5) * 2 + ((iy & 1) != 0 ? 0.25 : -0.25)) * cell,
                          (iy + 0.5 + 0.24 * (r(2) - 0.5) * 2) * cell);
        const double size = cell * (0.24 + 0.14 * r(3)), turn = 2 * pi * r(4);
        const Vec2 d = p - centre;
        const double rho = d.norm(), theta = std::atan2(d.y(), d.x()) - turn;
        if (layer == 0) {
          for (const double at : {0.6, 2.5, 4.6}) {
            const Vec2 axis(std::cos(turn + at), std::sin(turn + at)), q = d - 1.15 * size * axis;
            const double along = q.dot(axis) / (0.55 * size),
                         across = (axis.x() * q.y() - axis.y() * q.x()) / (0.24 * size);
            const double edge = std::sqrt(along * along + across * across);
            mix(colour, leaf, 1 - smooth_step(1 - soft / (0.3 * size), 1 + soft / (0.3 * size), edge));
          }
        } else {
          const double edge = size * (0.62 + 0.38 * std::pow(std::abs(std::cos(2.5 * theta)), 0.7));
          const double shade = 0.82 + 0.18 * std::min(1.0, rho / size);
          mix(colour, petal * static_cast<float>(shade), 1 - smooth_step(edge - soft, edge + soft, rho));
          mix(colour, linear({214, 158, 60}), 1 - smooth_step(0.22 * size - soft, 0.22 * size + soft, rho));
        }
      }
}

cv::Vec3f fabric_at(const PhotoSpec& s, const Vec2& p, double soft, const cv::Vec3f& base, const cv::Vec3f& second) {
  cv::Vec3f colour = base;
  double weave = 1 + 0.035 * noise(p.x() * 6, p.y() * 6, 11) + 0.02 * std::sin(2 * pi * p.x() / 0.24);
  switch (s.fabric) {
    case Fabric2d::plain:
      break;
    case Fabric2d::heather: {
      const double fibre = noise(p.x() * 2.4, p.y() * 8, 21) + 0.8 * noise(p.x() * 5, p.y() * 11, 22);
      mix(colour, second, std::clamp(0.20 + 0.17 * fibre, 0.0, 0.6));
      break;
    }
    case Fabric2d::stripes:
      mix(colour, second, std::clamp(stripe(p.y(), s.pattern, soft), 0.0, 1.0));
      break;
    case Fabric2d::diagonal:
      mix(colour, second, std::clamp(stripe((p.x() + p.y()) * std::numbers::sqrt2 / 2, s.pattern, soft), 0.0, 1.0));
      break;
    case Fabric2d::dots: {
      const double row = std::floor(p.y() / s.pattern), shift = std::fmod(std::abs(row), 2.0) < 0.5 ? 0.0 : 0.5;
      const double fx = p.x() / s.pattern + shift, fy = p.y() / s.pattern;
      const double d = s.pattern * std::hypot(fx - std::floor(fx) - 0.5, fy - std::floor(fy) - 0.5),
                   r = 0.2 * s.pattern;
      mix(colour, second, 1 - smooth_step(r - soft, r + soft, d));
      break;
    }
    case Fabric2d::floral:
      floral(s, p, soft, colour);
      break;
    case Fabric2d::denim: {
      const double twill = std::sin(2 * pi * (p.x() + 1.7 * p.y()) / 0.30);
      const double slub = noise(p.x() * 5.5, p.y() * 0.5, 31) + 0.6 * noise(p.x() * 11, p.y() * 1.6, 32);
      weave = 1 + 0.06 * twill + 0.09 * slub + 0.06 * noise(p.x() * 9, p.y() * 9, 33);
      // Washed out where it is worn: in the middle of both halves.
      const double q = (std::abs(p.x()) - 0.25 * s.hip) / (0.17 * s.hip),
                   v = (p.y() - 0.52 * s.length) / (0.36 * s.length);
      mix(colour, second, 0.34 * std::exp(-q * q - v * v) * (1 + 0.25 * noise(p.x() / 3, p.y() / 3, 34)));
      break;
    }
  }
  return colour * static_cast<float>(weave);
}

}  // namespace

void add_fabric(const PhotoSpec& spec, const Shape& shape, const Canvas& canvas, Layers& layers) {
  layers.colour = cv::Mat3f(canvas.height, canvas.width, cv::Vec3f(0, 0, 0));
  layers.part = cv::Mat1b(canvas.height, canvas.width, static_cast<std::uint8_t>(0));
  std::array<Vec2, 2> origin, along;
  for (int i = 0; i < 2 && has_sleeves(spec.garment); ++i) {
    const cv::Mat1f sleeve = coverage(shape.sleeve[i], canvas);
    layers.part.setTo(i + 1, sleeve > 0.5);
    // The rim of anti-aliased pixels outside belongs to the sleeve too.
    const std::string name = i == 0 ? "_left" : "_right";
    origin[i] = shape.landmarks.at("shoulder" + name);
    along[i] = (shape.landmarks.at("cuff_upper" + name) - origin[i]).normalized();
  }
  const cv::Vec3f base = linear(spec.colour), second = linear(spec.second);
  const double soft = 0.6 / canvas.scale;
  for (int y = 1; y + 1 < canvas.height; ++y)
    for (int x = 1; x + 1 < canvas.width; ++x) {
      if (layers.total(y, x) <= 0) continue;
      Vec2 p = canvas.cm(Vec2(x, y));
      p -= warp(p, spec) - p;
      // A slope shows more cloth per pixel: patterns bend over folds.
      const Vec2 slope =
          0.5 * canvas.scale *
          Vec2(layers.relief(y, x + 1) - layers.relief(y, x - 1), layers.relief(y + 1, x) - layers.relief(y - 1, x));
      p += 0.55 * slope / (1 + 1.6 * slope.norm());
      if (const int part = layers.part(y, x); part > 0) {
        const Vec2 q = p - origin[part - 1], a = along[part - 1];
        p = Vec2(a.y() * q.x() - a.x() * q.y() + 60 * part, a.dot(q) + spec.shoulder_drop);
      } else if (spec.fabric == Fabric2d::floral || spec.fabric == Fabric2d::dots) {
        if (spec.side == Side::back) p += Vec2(71.3, 33.7);  // another piece of the same cloth
      }
      layers.colour(y, x) = fabric_at(spec, p, soft, base, second);
    }
}

void add_motif(const PhotoSpec& spec, const Canvas& canvas, Layers& layers) {
  const cv::Vec3f ink = linear(spec.second);
  const double grow = spec.side == Side::front ? 1 : 0.2;
  const Vec2 centre(0, spec.side == Side::front ? spec.neck_depth + 14.5 : spec.back_neck_depth + 6);
  const auto place = [&](double x, double y) { return warp(centre + grow * Vec2(x, y), spec); };
  const auto fill = [&](const Curve& outline, const std::function<double(const Vec2&)>& share, bool inked) {
    const cv::Mat1f area = coverage(outline, canvas);
    const cv::Vec3f cloth = linear(spec.colour);
    for (int y = 0; y < canvas.height; ++y)
      for (int x = 0; x < canvas.width; ++x)
        if (area(y, x) > 0 && layers.total(y, x) > 0) {
          const double wear = 0.93 + 0.05 * noise(x * 0.31, y * 0.31, spec.seed);
          const Vec2 laid = canvas.cm(Vec2(x, y)), flat = 2 * laid - warp(laid, spec);
          mix(layers.colour(y, x), inked ? ink : cloth,
              area(y, x) * share((flat - centre) / grow) * (inked ? wear : 1));
        }
  };
  Curve sun;
  for (int i = 0; i < 90; ++i) sun.push_back(place(8 * std::cos(i * pi / 45), -1.5 + 8 * std::sin(i * pi / 45)));
  const double soft = 0.6 / canvas.scale / grow;
  fill(
      sun,
      [&](const Vec2& p) {  // bars that grow towards the horizon
        const double t = (p.y() + 3) / 1.55, wide = std::clamp(0.12 + 0.11 * t, 0.0, 0.8);
        const double f = t - std::floor(t);
        return p.y() < -3 ? 1.0 : smooth_step(wide - soft, wide + soft, f);
      },
      true);
  if (grow < 1) return;
  const std::array<std::array<double, 6>, 3> peaks{
      {{-12.5, 8, -6, -3.5, 1.5, 8}, {-0.5, 8, 6.2, -2, 12.5, 8}, {-6.5, 8, 0.4, 1.2, 6.8, 8}}};
  for (const auto& k : peaks) {
    Curve peak;  // in short steps: the cloth is not laid down quite straight
    for (int i = 0; i < 36; ++i) {
      const int a = i / 12 * 2, b = (a + 2) % 6;
      const double t = i % 12 / 12.0;
      peak.push_back(place(k[a] + t * (k[b] - k[a]), k[a + 1] + t * (k[b + 1] - k[a + 1])));
    }
    fill(
        peak, [](const Vec2&) { return 1.0; }, false);
    const double foot = k[1], top = k[3], tip = k[2];
    fill(
        peak,
        [&](const Vec2& p) {  // the lit flank is hatched, the outline is drawn
          const double down = (p.y() - top) / (foot - top);
          const double right = tip + down * (k[4] - tip), left = tip + down * (k[0] - tip);
          const double rim = std::min({p.x() - left, right - p.x(), (foot - p.y()) * 1.6});
          const double f = (p.x() - tip + 0.75 * (p.y() - top)) / 0.95;
          const double hatch = p.x() > tip + 0.9 * down * std::sin(3 * down)
                                   ? smooth_step(0.55 - soft, 0.55 + soft, f - std::floor(f))
                                   : 0;
          return std::max(1 - smooth_step(0.5 - soft, 0.5 + soft, rim), hatch);
        },
        true);
  }
}

}  // namespace vitrine::support
