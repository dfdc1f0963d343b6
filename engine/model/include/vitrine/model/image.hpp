// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vitrine {

/// 8-bit interleaved picture, rows top to bottom, no padding. 1 (grey, labels), 3 (RGB) or 4 (RGBA) channels.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<std::uint8_t> data;  ///< width * height * channels bytes

  Image() = default;
  Image(int w, int h, int c, std::uint8_t value = 0)
      : width(w), height(h), channels(c), data(static_cast<std::size_t>(w) * h * c, value) {}
  bool empty() const { return data.empty(); }
  std::uint8_t* at(int x, int y) { return &data[(static_cast<std::size_t>(y) * width + x) * channels]; }
  const std::uint8_t* at(int x, int y) const { return &data[(static_cast<std::size_t>(y) * width + x) * channels]; }
};

/// The three labels of a silhouette image.
enum Label : std::uint8_t {
  label_background = 0,
  label_inside = 128,  ///< the inside of the garment's back, seen above the front neckline or inside a waistband
  label_outside = 255  ///< the panel's own outer face
};

}  // namespace vitrine
