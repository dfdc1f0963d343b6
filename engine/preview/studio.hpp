// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "camera.hpp"
#include "texture_lookup.hpp"
#include "tracer.hpp"
#include "vitrine/preview.hpp"

namespace vitrine {

/// The lit room: what a ray from the camera sees, in linear RGB.
class Studio {
 public:
  Studio(std::span<const RenderMesh> meshes, const Tracer& tracer, const Framing& framing,
         const PreviewOptions& options);

  /// Colour along the ray through a film point; `x`, `y` name the pixel, `sample` the ray within it.
  Colour look(const Camera& camera, const Vec2& film, int x, int y, int sample) const;
  /// The empty backdrop.
  Colour backdrop() const;

 private:
  Colour shade(const Camera& camera, const Vec3& direction, const Hit& hit, int x, int y, int sample) const;
  Colour floor(const Camera& camera, const Vec2& film, const Vec3& direction, int x, int y, int sample) const;
  double openness(const Vec3& point, const Vec3& normal, double reach, int x, int y, int sample) const;

  double lit(const Vec3& point, const Vec3& towards, double spread, int x, int y, int sample) const;

  std::span<const RenderMesh> meshes_;
  const Tracer& tracer_;
  const Framing& framing_;
  const PreviewOptions& options_;
  std::vector<TextureLookup> textures_;
  double shadow_radius_ = 0;  ///< [m] around the pivot in which the floor can be dark
};

}  // namespace vitrine
