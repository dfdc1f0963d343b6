// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

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
  /// How many of `rays` rays from one point have nothing in their way; `ray(k)` is the k-th one's direction and reach
  /// [m]. They go four at a time: where they are short or go much the same way, they pass the same few boxes.
  template <class F>
  int count_free(const Vec3& from, int rays, F&& ray) const {
    int free = 0;
    for (int k = 0; k < rays; k += 4) {
      std::array<Vec3, 4> directions;
      std::array<double, 4> reach;
      const int count = std::min(4, rays - k);
      for (int i = 0; i < 4; ++i) std::tie(directions[i], reach[i]) = ray(k + std::min(i, count - 1));
      const std::array<bool, 4> in_the_way = blocked(from, directions, reach);
      free += static_cast<int>(std::count(in_the_way.begin(), in_the_way.begin() + count, false));
    }
    return free;
  }
  /// Four rays from one point that go much the same way, at the price of about one and a half.
  std::array<std::optional<Hit>, 4> first_hits(const Vec3& from, const std::array<Vec3, 4>& directions) const;

 private:
  struct Scene;
  explicit Tracer(std::shared_ptr<Scene> scene) : scene_(std::move(scene)) {}
  std::array<bool, 4> blocked(const Vec3& from, const std::array<Vec3, 4>& directions,
                              const std::array<double, 4>& reach) const;
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
