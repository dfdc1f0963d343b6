// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "vitrine/model/geometry.hpp"
#include "vitrine/model/image.hpp"

namespace vitrine {

/// How a texture is laid out and used, on the texture's own grid.
struct UvFigures {
  double low = 0, high = 1;  ///< least and greatest coordinate
  int inverted = 0;          ///< triangles wound the other way round
  double overlap_share = 0;  ///< [-] of the covered texels
  int gutter = 0;            ///< [px] between charts and to the border, at least; 0 when they touch
  int charts = 0;            ///< connected parts
  double dark_share = 0;     ///< [-] of the covered texels with the brightest channel below 30
  double bright_share = 0;   ///< [-] with the brightest channel above 243
};

/// `triangles` index `uv` (glTF: (0,0) top left); triangles that share vertices are one chart. `texture` has 3
/// channels.
UvFigures measure_uv(const std::vector<Vec2>& uv, const std::vector<Triangle>& triangles, const Image& texture);

}  // namespace vitrine
