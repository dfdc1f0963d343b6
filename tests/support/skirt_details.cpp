// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include "noise.hpp"
#include "photo_parts.hpp"

namespace vitrine::support {
namespace {

struct Tailor {
  const PhotoSpec& spec;
  const Shape& shape;
  const Canvas& canvas;
  Layers& layers;

  Vec2 at(double x, double y) const { return warp({x, y}, spec); }
  Curve path(std::initializer_list<Vec2> points) const {  // Catmull-Rom through the points
    const std::vector<Vec2> p(points);
    Curve curve;
    for (std::size_t i = 0; i + 1 < p.size(); ++i) {
      const Vec2 a = p[i == 0 ? 0 : i - 1], b = p[i], c = p[i + 1], d = p[std::min(i + 2, p.size() - 1)];
      for (int k = 0; k < 12; ++k) {
        const double t = k / 12.0;
        curve.push_back(
            0.5 * (2 * b + t * (c - a) + t * t * (2 * a - 5 * b + 4 * c - d) + t * t * t * (3 * b - a - 3 * c + d)));
      }
    }
    curve.push_back(p.back());
    for (Vec2& q : curve) q = warp(q, spec);
    return curve;
  }
  Curve straight(std::initializer_list<Vec2> corners) const {
    const std::vector<Vec2> p(corners);
    Curve curve;
    for (std::size_t i = 0; i + 1 < p.size(); ++i)
      for (int k = 0; k < 10; ++k)
        curve.push_back(at((p[i] + (p[i + 1] - p[i]) * k / 10).x(), (p[i] + (p[i + 1] - p[i]) * k / 10).y()));
    curve.push_back(warp(p.back(), spec));
    return curve;
  }

  void disc(const Vec2& where, double radius, const Rgb& rgb, bool holes) {
    const Vec2 centre = warp(where, spec), c = canvas.px(centre);
    const cv::Vec3f colour = linear(rgb);
    const double r = radius * canvas.scale;
    for (int y = std::max(0, static_cast<int>(c.y() - 2 * r));
         y <= std::min(canvas.height - 1, static_cast<int>(c.y() + 2 * r)); ++y)
      for (int x = std::max(0, static_cast<int>(c.x() - 2 * r));
           x <= std::min(canvas.width - 1, static_cast<int>(c.x() + 2 * r)); ++x) {
        const Vec2 d = (Vec2(x, y) - c) / r;
        const double rho = d.norm(), soft = 0.7 / r;
        // It throws a small shadow to the lower right.
        const double shade = 1 - smooth_step(0.8, 1.5, (d - Vec2(0.22, 0.28)).norm());
        layers.colour(y, x) *= static_cast<float>(1 - 0.4 * shade);
        const double rim = bell((rho - 0.8) / 0.14), lit = -(d.x() + d.y()) / (rho + 0.2);
        double grey = 1 + 0.30 * rim * lit - 0.12 * bell((rho - 0.6) / 0.12);
        if (holes)
          for (const double sx : {-1.0, 1.0})
            for (const double sy : {-1.0, 1.0}) grey -= 0.6 * bell((d - 0.24 * Vec2(sx, sy)).norm() / 0.12);
        mix(layers.colour(y, x), colour * static_cast<float>(std::max(0.1, grey)),
            1 - smooth_step(1 - soft, 1 + soft, rho));
      }
  }

  void waistband(const cv::Vec3f& thread) {
    const bool denim = spec.fabric == Fabric2d::denim;
    const Curve& top = spec.side == Side::front ? shape.top_front : shape.top_back;
    const cv::Vec3f trim = linear(spec.trim);
    const double wide = spec.waistband, soft = 0.6 / canvas.scale;
    paint_near(top, wide + 0.6, canvas, [&](int x, int y, double d, double along, bool) {
      if (layers.face(y, x) <= 0) return;
      const double on = 1 - smooth_step(wide - soft, wide + soft, d);
      const double weave = denim ? 1 + 0.07 * std::sin(21 * (along - 1.6 * d)) + 0.07 * noise(along * 0.6, d * 6, 41)
                                 : 1 + 0.04 * noise(x * 0.5, y * 0.5, 42);
      mix(layers.colour(y, x), trim * static_cast<float>(weave), on);
      layers.relief(y, x) += static_cast<float>(0.07 * on);
    });
    add_seam(top, wide, canvas, layers);
    add_stitches(top, 0.3, 1, 0.3, thread, canvas, layers);
    add_stitches(top, wide - 0.3, 1, 0.3, thread, canvas, layers);
  }

  void loop(double x, const cv::Vec3f& thread) {
    const double h = 0.55, low = spec.waistband + 0.7, high = spec.side == Side::front ? spec.waist_dip * 0.8 - 0.1 : 0;
    const Curve outline = straight({{x - h, high}, {x + h, high}, {x + h, low}, {x - h, low}, {x - h, high}});
    const cv::Mat1f area = coverage(outline, canvas);
    for (int y = 0; y < canvas.height; ++y)
      for (int c = 0; c < canvas.width; ++c)
        if (area(y, c) > 0) {
          mix(layers.colour(y, c), linear(spec.trim) * static_cast<float>(1.12 + 0.08 * noise(c * 0.6, y * 0.6, 43)),
              area(y, c));
          layers.relief(y, c) += 0.09f * area(y, c);
        }
    add_stitches(straight({{x - h + 0.22, high}, {x - h + 0.22, low}}), 0, 1, 0.3, thread, canvas, layers);
    add_stitches(straight({{x + h - 0.22, high}, {x + h - 0.22, low}}), 0, 1, 0.3, thread, canvas, layers);
  }

  /// The hem of a skirt, the openings of trousers.
  void hem_stitches(double inset, int rows, double gap, const cv::Vec3f& thread) {
    if (!has_legs(spec.garment)) return add_stitches(shape.hem, inset, rows, gap, thread, canvas, layers);
    for (const Curve& cuff : shape.cuff) add_stitches(cuff, inset, rows, gap, thread, canvas, layers);
  }

  /// Trousers: the fly, the crotch's seam and, below it, what is seen of the inside legs where they lie on each other.
  void legs() {
    const cv::Vec3f thread = linear(spec.trim) * 0.8f;
    const double dip = spec.side == Side::front ? spec.waist_dip : 0, foot = spec.waistband + dip;
    add_seam(straight({{0, foot}, {0, spec.rise + spec.touch}}), 0, canvas, layers);
    const double w = spec.chest / 2;
    for (const double s : {-1.0, 1.0}) {
      const Curve pocket = spec.side == Side::front
                               ? straight({{s * 0.7 * w, foot}, {s * (w + 1.5), foot + 0.55 * spec.rise}})
                               : straight({{s * 0.3 * w, foot + 6}, {s * 0.8 * w, foot + 6}});
      add_seam(pocket, 0, canvas, layers);
      add_stitches(pocket, 0.35, 1, 0.45, thread, canvas, layers);
    }
    if (spec.side == Side::front)
      add_stitches(path({{2.6, foot}, {2.6, foot + 0.3 * spec.rise}, {0.2, foot + 0.5 * spec.rise}}), 0, 1, 0.45,
                   thread, canvas, layers);
    waistband(thread);
    for (const double x : {-0.62, 0.62}) loop(x * w, thread);
    if (spec.side == Side::front) disc({0.2, dip + 0.5 * spec.waistband}, 0.8, {112, 90, 72}, true);
    hem_stitches(1.6, 1, 0.42, thread);
  }

  void jeans() {
    const cv::Vec3f thread = linear({206, 150, 84});
    const double end = has_legs(spec.garment) ? spec.rise + spec.touch : spec.length;  // of the seam in the middle
    const double w = spec.chest / 2, band = spec.waistband, dip = spec.side == Side::front ? spec.waist_dip : 0;
    const double foot = band + dip;  // lower edge of the waistband in the middle
    if (spec.side == Side::front) {
      add_seam(straight({{0, foot}, {0, end}}), 0, canvas, layers);
      add_stitches(straight({{-0.35, foot + 14.5}, {-0.35, std::max(foot + 14.6, end - 0.2)}}), 0, 1, 0.3, thread,
                   canvas, layers);
      add_stitches(path({{3.1, foot}, {3.1, foot + 8}, {2.5, foot + 12}, {0.2, foot + 14.5}}), 0, 2, 0.45, thread,
                   canvas, layers);
      for (const double s : {-1.0, 1.0}) {
        const Curve pocket = path({{s * 0.50 * w, band + 0.55 * dip},
                                   {s * 0.56 * w, band + 4.5},
                                   {s * 0.80 * w, band + 7.4},
                                   {s * (w + 2.6), band + 8.3}});
        add_seam(pocket, 0, canvas, layers);
        add_stitches(pocket, 0.35, 2, 0.45, thread, canvas, layers);
        disc({s * 0.515 * w, band + 1.6}, 0.32, {176, 112, 70}, false);
        disc({s * (w + 1.2), band + 7.6}, 0.32, {176, 112, 70}, false);
      }
    } else {
      for (const double s : {-1.0, 1.0}) {
        const Curve yoke = straight({{0, band + 6.5}, {s * (w + 1.4), band + 3.2}});
        add_seam(yoke, 0, canvas, layers);
        add_stitches(yoke, 0.35, 2, 0.45, thread, canvas, layers);
        const double x = s * 0.56 * w, top = band + 8;
        const Curve pocket = straight(
            {{x - 6, top}, {x - 5.4, top + 11.5}, {x, top + 13.6}, {x + 5.4, top + 11.5}, {x + 6, top}, {x - 6, top}});
        add_seam(pocket, 0, canvas, layers);
        add_stitches(pocket, 0.3, 2, 0.45, thread, canvas, layers);
        add_stitches(
            path({{x - 5.6, top + 6.2}, {x - 2, top + 5.2}, {x, top + 7}, {x + 2, top + 5.2}, {x + 5.6, top + 6.2}}), 0,
            2, 0.45, thread, canvas, layers);
      }
      add_seam(straight({{0, band}, {0, end}}), 0, canvas, layers);
      add_stitches(straight({{0.35, band + 0.5}, {0.35, end - 0.2}}), 0, 1, 0.3, thread, canvas, layers);
    }
    waistband(thread);
    for (const double x : {-0.62, 0.62}) loop(x * w, thread);
    if (spec.side == Side::back)
      loop(0, thread);
    else
      disc({0.2, dip + 0.5 * band}, 0.95, {188, 126, 82}, false);
    hem_stitches(1.2, 2, 0.45, thread);
  }

  void buttoned() {
    const cv::Vec3f thread = linear(spec.trim) * 0.8f;
    const double dip = spec.side == Side::front ? spec.waist_dip : 0;
    if (spec.side == Side::front) {
      for (const double x : {-1.7, 1.7}) {
        const Curve edge = straight({{x, spec.waistband + dip}, {x, spec.length - 0.1}});
        add_seam(edge, 0, canvas, layers);
        add_stitches(edge, 0.3, 1, 0.3, thread, canvas, layers);
      }
    } else {
      add_seam(straight({{0, spec.waistband}, {0, spec.waistband + 19}}), 0, canvas, layers);
      add_stitches(straight({{0.55, spec.waistband + 0.3}, {0.55, spec.waistband + 19}}), 0, 1, 0.3, thread, canvas,
                   layers);
    }
    waistband(thread);
    if (spec.side == Side::front)
      for (double y = dip + 0.5 * spec.waistband; y < spec.length - 4; y += 7.2)
        disc({0, y}, 0.75, {112, 66, 52}, true);
    hem_stitches(1.6, 1, 0.42, thread);
  }
};

}  // namespace

void add_skirt_details(const PhotoSpec& spec, const Shape& shape, const Canvas& canvas, Layers& layers) {
  Tailor tailor{spec, shape, canvas, layers};
  if (spec.fabric == Fabric2d::denim)
    tailor.jeans();
  else if (has_legs(spec.garment))
    tailor.legs();
  else
    tailor.buttoned();
}

}  // namespace vitrine::support
