// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <opencv2/core.hpp>

#include "vitrine/model/geometry.hpp"

namespace vitrine {

/// Sixteenths of a pixel: OpenCV's drawing takes fixed-point coordinates, here with `shift` = 4 fractional bits.
inline cv::Point fixed(const Vec2& p) {
  return {static_cast<int>(std::lround(p.x() * 16)), static_cast<int>(std::lround(p.y() * 16))};
}

}  // namespace vitrine
