// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>

#include "vitrine/model/result.hpp"
#include "vitrine/texture.hpp"

namespace vitrine {

/// A panel's region of its photo, every pixel of it garment-coloured. Photo pixel (x, y) is the centre of cutout pixel
/// (x - left, y - top).
struct Cutout {
  cv::Mat rgb;   ///< CV_8UC3
  cv::Mat keep;  ///< CV_8UC1: 255 where the photo's own pixel was kept
  int left = 0, top = 0;
  std::vector<Vec2> pixels;                  ///< per node: position in the photo [px], integers are pixel centres
  double density = 0;                        ///< [px/m] of the photo along the panel
  double print_share = 0, filled_share = 0;  ///< [-] as in TextureFigures
};

/// Crops the box of the panel's nodes plus `margin` photo pixels and replaces everything that is not the panel's outer
/// face: by cloth of the panel where a place is large, by colours from a little inside its edge along the rim.
Result<Cutout> cut_out(const TextureSource& source, int margin);

}  // namespace vitrine
