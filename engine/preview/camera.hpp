// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "vitrine/model/garment.hpp"
#include "vitrine/preview.hpp"

namespace vitrine {

/// A long lens on a level tripod, the film shifted instead of the camera tilted: uprights stay upright, as in shop
/// pictures. The film is the plane through the pivot; film coordinates are metres there.
struct Camera {
  Vec3 pivot;             ///< y = 0
  Vec3 right, up, back;   ///< `back` points from the subject to the camera
  double distance = 0;    ///< [m] eye to film plane
  double eye_height = 0;  ///< [m]

  Vec3 eye() const { return pivot + distance * back + eye_height * up; }
  /// Where a point appears [m on the film].
  Vec2 project(const Vec3& p) const;
  /// Unit direction from the eye through a point of the film.
  Vec3 direction(const Vec2& film) const;
};

/// The views at one scale.
struct Framing {
  std::vector<Camera> cameras;  ///< one for each turn
  double pixel = 0;             ///< [m] on the film
  Vec2 top_left;                ///< film position of the picture's corner
  Vec2 low, high;               ///< film box of the subject over all views
  double ground = 0;            ///< [m] height of the floor
};

Framing frame_subject(std::span<const RenderMesh> meshes, const PreviewOptions& options);

}  // namespace vitrine
