// SPDX-License-Identifier: GPL-3.0-or-later
#include "camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vitrine {
namespace {

constexpr double kDistance = 3.6;   // times the subject's size: a portrait lens
constexpr double kLookDown = 0.20;  // eye above the middle, share of the size: shows the floor's shadow
constexpr double kMarginSide = 0.05, kMarginTop = 0.035, kMarginBottom = 0.06;  // shares of the frame

}  // namespace

Vec2 Camera::project(const Vec3& p) const {
  const Vec3 d = p - pivot;
  const double scale = distance / (distance - d.dot(back));
  return {d.dot(right) * scale, eye_height + (p.y() - eye_height) * scale};
}

Vec3 Camera::direction(const Vec2& film) const {
  return (film.x() * right + (film.y() - eye_height) * up - distance * back).normalized();
}

Framing frame_subject(std::span<const RenderMesh> meshes, const PreviewOptions& options) {
  Vec3 low = Vec3::Constant(1e30), high = Vec3::Constant(-1e30);
  for (const RenderMesh& mesh : meshes)
    for (const Vec3& p : mesh.positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  // Everything on the floor that is drawn has to be above it, whatever the camera is set up for.
  const double lowest = low.y();
  if (options.subject) {
    low = options.subject->low;
    high = options.subject->high;
  }
  const double size = std::max((high - low).maxCoeff(), 1e-3);

  Framing f;
  f.ground = std::min({0.0, low.y(), lowest});
  f.low = Vec2::Constant(1e30);
  f.high = Vec2::Constant(-1e30);
  for (double angle : options.turns_deg) {
    const double a = angle * std::numbers::pi / 180.0;
    Camera c;
    c.pivot = Vec3(0.5 * (low.x() + high.x()), 0.0, 0.5 * (low.z() + high.z()));
    c.right = Vec3(std::cos(a), 0, -std::sin(a));
    c.up = Vec3::UnitY();
    c.back = Vec3(std::sin(a), 0, std::cos(a));
    c.distance = kDistance * size;
    c.eye_height = 0.5 * (low.y() + high.y()) + kLookDown * size;
    const auto cover = [&](const Vec3& p) {
      const Vec2 q = c.project(p);
      f.low = f.low.cwiseMin(q);
      f.high = f.high.cwiseMax(q);
    };
    if (options.subject)
      for (int corner = 0; corner < 8; ++corner)
        cover({corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(), corner & 4 ? high.z() : low.z()});
    else
      for (const RenderMesh& mesh : meshes)
        for (const Vec3& p : mesh.positions) cover(p);
    f.cameras.push_back(c);
  }

  double bottom = options.frame_bottom, top = options.frame_top;
  if (bottom < 0 && top < 0) {
    const double half = std::max(-f.low.x(), f.high.x());
    const double height = (f.high.y() - f.low.y()) / (1.0 - kMarginTop - kMarginBottom);
    const double needed = 2.0 * half / (1.0 - 2.0 * kMarginSide) * options.view_height / options.view_width;
    const double tall = std::max({height, needed, 1e-3});
    // What the width needs more than the height is shared above and below.
    bottom = f.low.y() - kMarginBottom * height - 0.5 * (tall - height);
    top = bottom + tall;
  }
  f.pixel = (top - bottom) / options.view_height;
  f.top_left = Vec2(-0.5 * f.pixel * options.view_width, top);
  return f;
}

}  // namespace vitrine
