// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include "noise.hpp"
#include "photo_parts.hpp"

namespace vitrine::support {
namespace {

using std::numbers::pi;

/// A knitted band along a curve: its own colour, ribs across it, raised a little, sewn on.
void add_rib(const Curve& curve, double wide, int part, const PhotoSpec& spec, const Canvas& canvas, Layers& layers) {
  const cv::Vec3f trim = linear(spec.trim);
  const cv::Vec3f heather = linear(spec.second);
  const double soft = 0.5 / canvas.scale;
  paint_near(curve, wide + 0.4, canvas, [&](int x, int y, double d, double along, bool) {
    if (layers.face(y, x) <= 0 || (part >= 0 && layers.part(y, x) != part)) return;
    const double inside = 1 - smooth_step(wide - soft, wide + soft, d);
    const double rib = std::cos(2 * pi * along / 0.42);
    cv::Vec3f colour = trim * static_cast<float>(1 + 0.10 * rib + 0.03 * noise(x * 0.9, y * 0.9, 5));
    if (spec.fabric == Fabric2d::heather)
      mix(colour, heather, std::clamp(0.18 + 0.25 * noise(x * 0.45, y * 0.45, 6), 0.0, 0.6));
    mix(layers.colour(y, x), colour, inside);
    layers.relief(y, x) +=
        static_cast<float>(0.05 * inside * std::sin(pi * std::min(1.0, d / wide)) + 0.004 * inside * rib);
    const double groove = bell((d - wide) / 0.09);
    layers.colour(y, x) *= static_cast<float>(1 - 0.35 * groove);
    layers.relief(y, x) -= static_cast<float>(0.03 * groove);
  });
}

}  // namespace

void add_stitches(const Curve& curve, double inset, int rows, double gap, const cv::Vec3f& thread, const Canvas& canvas,
                  Layers& layers) {
  const double half = std::max(0.045, 0.5 / canvas.scale), pace = std::max(0.34, 4.6 / canvas.scale);
  double length = 0;
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) length += (curve[i + 1] - curve[i]).norm();
  paint_near(curve, inset + rows * gap + 0.5, canvas, [&](int x, int y, double d, double along, bool) {
    // Rows run beside the curve, not round its ends.
    if (layers.face(y, x) <= 0 || along < 0.02 || along > length - 0.02) return;
    for (int row = 0; row < rows; ++row) {
      const double off = std::abs(d - inset - row * gap);
      if (off > 0.5) continue;
      const double f = along / pace + 0.37 * row, dash = std::abs(f - std::floor(f) - 0.5);
      const double on = (1 - smooth_step(0.6 * half, 1.7 * half, off)) * (1 - smooth_step(0.26, 0.40, dash));
      layers.relief(y, x) -= static_cast<float>(0.022 * bell(off / 0.16) * (1 + 0.5 * std::sin(along * 5.1 + row)));
      layers.colour(y, x) *= static_cast<float>(1 - 0.12 * bell(off / 0.1));
      mix(layers.colour(y, x), thread, 0.8 * on);
    }
  });
}

void add_seam(const Curve& curve, double inset, const Canvas& canvas, Layers& layers) {
  paint_near(curve, inset + 0.6, canvas, [&](int x, int y, double d, double along, bool) {
    if (layers.face(y, x) <= 0) return;
    const double off = std::abs(d - inset);
    layers.colour(y, x) *= static_cast<float>(1 - 0.45 * bell(off / std::max(0.06, 0.7 / canvas.scale)));
    layers.relief(y, x) -= static_cast<float>(0.045 * bell(off / 0.2) * (1 + 0.35 * std::sin(along * 4.3)));
  });
}

void add_top_details(const PhotoSpec& spec, const Shape& shape, const Canvas& canvas, Layers& layers) {
  const bool sleeves = has_sleeves(spec.garment);
  const cv::Vec3f thread = linear(spec.trim) * 0.75f;
  const Curve& neck = spec.side == Side::front ? shape.top_front : shape.top_back;
  if (sleeves)
    for (const Curve& armhole : shape.armhole) {
      add_seam(armhole, 0, canvas, layers);
      add_stitches(armhole, 0.4, 1, 0.3, thread, canvas, layers);
    }
  if (spec.rib > 0) {
    add_rib(neck, spec.rib, -1, spec, canvas, layers);
    add_stitches(neck, spec.rib + 0.35, 1, 0.3, thread, canvas, layers);
    if (!sleeves)
      for (const Curve& armhole : shape.armhole) {
        add_rib(armhole, 0.8 * spec.rib, 0, spec, canvas, layers);
        add_stitches(armhole, 0.8 * spec.rib + 0.35, 1, 0.3, thread, canvas, layers);
      }
    for (const Curve& shoulder : shape.shoulder) add_seam(shoulder, 0.7, canvas, layers);
  }
  if (spec.hem_rib > 0) {
    add_rib(shape.hem, spec.hem_rib, 0, spec, canvas, layers);
    for (int i = 0; i < 2 && sleeves; ++i) add_rib(shape.cuff[i], 0.9 * spec.hem_rib, i + 1, spec, canvas, layers);
    return;
  }
  paint_near(shape.hem, 2.4, canvas, [&](int x, int y, double d, double, bool) {  // turned up: double cloth
    layers.relief(y, x) += static_cast<float>(0.045 * (1 - smooth_step(1.9, 2.3, d)));
  });
  add_stitches(shape.hem, 2.1, 2, 0.42, thread, canvas, layers);
  for (int i = 0; i < 2 && sleeves; ++i) add_stitches(shape.cuff[i], 1.9, 2, 0.42, thread, canvas, layers);
}

}  // namespace vitrine::support
