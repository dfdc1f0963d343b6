// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sampling.hpp"

namespace vitrine {
namespace {

// Lights stand with the camera, so that every view is lit alike. (right, up, back)
const Vec3 kKey = Vec3(-0.50, 0.65, 0.80).normalized();
const Vec3 kFill = Vec3(0.60, 0.15, 0.78).normalized();
constexpr double kKeyPower = 0.62, kFillPower = 0.13, kSky = 0.58;
constexpr double kKeySpread = 0.22;   // tangent of the softbox' half angle
constexpr double kSkyBelow = 0.70;    // light from below against light from above
constexpr double kInnerSide = 0.72;   // cloth seen from inside gets what comes through
constexpr double kReach = 0.32;       // [m] how far folds and limbs shade each other
constexpr double kLift = 6e-4;        // [m] off the surface; the cloth lies 4 mm off the body
constexpr double kFloorReach = 0.45;  // [m] of the contact shadow
constexpr double kFloorDark = 0.75;   // how dark a fully covered floor gets
constexpr double kFloorCast = 0.10;   // the key light's own shadow on it
constexpr float kShoulder = 0.76F;    // linear; sRGB 226
constexpr double kFarthest = 10.0;    // [m] across any subject
constexpr float kBackdrop = 0.735F;   // linear; sRGB 223: white cloth still stands out

/// Below kShoulder colours stay exactly what they are; above, the brightest channel runs towards 1 without reaching it,
/// so that folds in white cloth are not burnt out. All channels shrink alike: hues stay.
Colour shoulder(const Colour& c) {
  const float top = c.maxCoeff();
  if (top <= kShoulder) return c;
  const float room = 1.0F - kShoulder;
  return c * ((kShoulder + room * (1.0F - std::exp((kShoulder - top) / room))) / top);
}

}  // namespace

Studio::Studio(std::span<const RenderMesh> meshes, const Tracer& tracer, const Framing& framing,
               const PreviewOptions& options)
    : meshes_(meshes), tracer_(tracer), framing_(framing), options_(options) {
  const double footprint = framing.pixel / std::sqrt(static_cast<double>(options.samples));
  const Vec3& pivot = framing.cameras.front().pivot;
  for (const RenderMesh& mesh : meshes) {
    textures_.emplace_back(mesh, footprint);
    for (const Vec3& p : mesh.positions)
      shadow_radius_ = std::max(shadow_radius_, std::hypot(p.x() - pivot.x(), p.z() - pivot.z()));
  }
  shadow_radius_ += kFloorReach;
}

Colour Studio::backdrop() const {
  return Colour::Constant(kBackdrop);
}

Colour Studio::look(const Camera& camera, const Vec2& film, int x, int y, int sample) const {
  const Vec3 from = camera.eye(), direction = camera.direction(film);
  if (const auto hit = tracer_.first_hit(from, direction)) return shade(camera, direction, *hit, x, y, sample);
  return floor(camera, film, direction, x, y, sample);
}

/// Share of the hemisphere over `normal` that is open, cosine-weighted; near things count more than far ones because
/// each ray has a reach of its own.
double Studio::openness(const Vec3& point, const Vec3& normal, double reach, int x, int y, int sample) const {
  if (options_.occlusion_rays == 0) return 1.0;
  const Sequence sequence(x, y, 1);
  int open = 0;
  for (int k = 0; k < options_.occlusion_rays; ++k) {
    const int i = sample * options_.occlusion_rays + k;
    const Vec3 d = cosine_direction(normal, sequence.point(i));
    if (!tracer_.blocked(point, d, reach * (0.06 + 0.94 * sequence.third(i)))) ++open;
  }
  return static_cast<double>(open) / options_.occlusion_rays;
}

/// Share of a lamp in direction `towards` that reaches a point.
double Studio::lit(const Vec3& point, const Vec3& towards, double spread, int x, int y, int sample) const {
  const Sequence sequence(x, y, 2);
  const int rays = std::max(1, options_.occlusion_rays / 4);
  int open = 0;
  for (int k = 0; k < rays; ++k)
    if (!tracer_.blocked(point, cone_direction(towards, spread, sequence.point(sample * rays + k)), kFarthest)) ++open;
  return static_cast<double>(open) / rays;
}

Colour Studio::shade(const Camera& camera, const Vec3& direction, const Hit& hit, int x, int y, int sample) const {
  const RenderMesh& mesh = meshes_[hit.mesh];
  const Triangle& t = mesh.triangles[hit.triangle];
  const double w[3] = {1.0 - hit.u - hit.v, hit.u, hit.v};
  const Vec3 corner[3] = {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
  Vec3 flat = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  if (!(flat.norm() > 0)) return backdrop();
  flat.normalize();
  const bool inner = flat.dot(direction) > 0;
  const double side = inner ? -1.0 : 1.0;
  flat *= side;

  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    point += w[i] * corner[i];
    normal += w[i] * side * mesh.normals[t[i]];
  }
  normal = normal.norm() > 1e-6 ? Vec3(normal.normalized()) : flat;
  // Rays start on the surface that the smooth normals suggest, not on the facet: facets would shadow themselves in
  // bands where the light grazes (Hanika, Hacking the Shadow Terminator, 2021).
  Vec3 start = point;
  for (int i = 0; i < 3; ++i) {
    const Vec3 n = side * mesh.normals[t[i]];
    const double below = std::min(0.0, (point - corner[i]).dot(n));
    start -= w[i] * below * n;
  }
  start += kLift * flat;

  double open = openness(start, normal, kReach, x, y, sample);
  const auto world = [&](const Vec3& l) {
    return Vec3(l.x() * camera.right + l.y() * camera.up + l.z() * camera.back);
  };
  const Vec3 key = world(kKey), fill = world(kFill);
  double light = kSky * open * (kSkyBelow + (1.0 - kSkyBelow) * (0.5 + 0.5 * normal.y()));
  light += kFillPower * std::max(0.0, normal.dot(fill)) * open;
  const double facing = normal.dot(key);
  if (facing > 0) {
    light += kKeyPower * facing * lit(start, key, kKeySpread, x, y, sample);
  }
  if (inner) light *= kInnerSide;

  double u = 0, v = 0;
  if (!mesh.uv.empty())
    for (int i = 0; i < 3; ++i) {
      u += w[i] * mesh.uv[t[i]].x();
      v += w[i] * mesh.uv[t[i]].y();
    }
  return shoulder(static_cast<float>(light) * textures_[hit.mesh].at(u, v));
}

/// A seamless sweep: one colour everywhere, darker only where the subject stands close.
Colour Studio::floor(const Camera& camera, const Vec2& film, const Vec3& direction, int x, int y, int sample) const {
  const Vec3 from = camera.eye();
  const double down = framing_.ground - from.y();
  if (!(direction.y() * down > 0)) return backdrop();
  const Vec3 point = from + direction * (down / direction.y());
  const double away = std::hypot(point.x() - camera.pivot.x(), point.z() - camera.pivot.z()) / shadow_radius_;
  if (away >= 1.0) return backdrop();
  const Vec3 start = point + kLift * Vec3::UnitY();
  const double covered = 1.0 - openness(start, Vec3::UnitY(), kFloorReach, x, y, sample);
  const Vec3 key = kKey.x() * camera.right + kKey.y() * camera.up + kKey.z() * camera.back;
  const double shadowed = 1.0 - lit(start, key, 2.0 * kKeySpread, x, y, sample);
  // Neighbouring views meet without a step.
  const double half = -framing_.top_left.x();
  const double fade =
      std::clamp(4.0 * (1.0 - away), 0.0, 1.0) * std::clamp((half - std::abs(film.x())) / (0.3 * half), 0.0, 1.0);
  const double dark = fade * (kFloorDark * covered + kFloorCast * shadowed);
  return backdrop() * static_cast<float>(1.0 - std::min(1.0, dark));
}

}  // namespace vitrine
