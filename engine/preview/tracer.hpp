// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <optional>
#include <span>

#include "vitrine/model/garment.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

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
