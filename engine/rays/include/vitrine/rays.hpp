// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <span>

#include "vitrine/model/garment.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

/// A place on a mesh's surface.
struct SurfacePoint {
  Vec3 point;   ///< [m] on the triangle
  Vec3 normal;  ///< unit, smooth
  Vec3 start;   ///< [m] where rays begin: on the surface that the smooth normals suggest, not on the facet, or facets
                ///< shadow themselves in bands where the light grazes (Hanika, Hacking the Shadow Terminator, 2021)
};
/// `weights` are barycentric; `side` -1 turns the surface over, to its inner face.
SurfacePoint surface_point(const RenderMesh& mesh, const Triangle& triangle, const std::array<double, 3>& weights,
                           double side = 1.0);

struct Hit {
  unsigned mesh = 0, triangle = 0;
  double u = 0, v = 0;  ///< barycentric weights of the triangle's second and third vertex
};

/// Rays against all meshes. Holds Embree's device and scene; one thread, so that it costs what a batch has granted it.
class Tracer {
 public:
  static Result<Tracer> build(std::span<const RenderMesh> meshes);
  std::optional<Hit> first_hit(const Vec3& from, const Vec3& direction) const;
  bool blocked(const Vec3& from, const Vec3& direction, double reach) const;
  /// Which of four rays from one point something is in the way of within its reach [m]. A ray of reach < 0 is none.
  std::array<bool, 4> blocked(const Vec3& from, const std::array<Vec3, 4>& directions,
                              const std::array<double, 4>& reach) const;
  /// Four rays from one point that go much the same way, at the price of about one and a half.
  std::array<std::optional<Hit>, 4> first_hits(const Vec3& from, const std::array<Vec3, 4>& directions) const;

 private:
  struct Scene;
  explicit Tracer(std::shared_ptr<Scene> scene) : scene_(std::move(scene)) {}
  std::shared_ptr<Scene> scene_;
};

class Sequence;

/// Share of the sky over a surface that is open, cosine-weighted, by `rays` rays. Each ray has a reach of its own, at
/// most `reach` [m], so that near things count more than far ones.
class Sky {
 public:
  Sky(const Tracer& tracer, int rays, double reach) : tracer_(tracer), rays_(rays), reach_(reach) {}
  double open(const Vec3& point, const Vec3& normal, const Sequence& sequence) const;

 private:
  const Tracer& tracer_;
  int rays_;
  double reach_;
};

}  // namespace vitrine
