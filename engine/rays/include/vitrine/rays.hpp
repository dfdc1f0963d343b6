// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
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

 private:
  struct Scene;
  explicit Tracer(std::shared_ptr<Scene> scene) : scene_(std::move(scene)) {}
  std::shared_ptr<Scene> scene_;
};

}  // namespace vitrine
