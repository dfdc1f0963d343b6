// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/colour.hpp"

#include <array>
#include <cmath>

namespace vitrine {
namespace {

constexpr int steps = 4096;  ///< of the cube root's table over 0..1

struct Tables {
  std::array<float, 256> linear;      ///< light of an sRGB value (IEC 61966-2-1)
  std::array<float, steps + 2> root;  ///< f(t) of CIE 15: cube root, with a straight foot
  Tables() {
    for (int i = 0; i < 256; ++i) {
      const double v = i / 255.0;
      linear[i] = static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
    }
    for (int i = 0; i < steps + 2; ++i) {
      const double t = static_cast<double>(i) / steps;
      root[i] = static_cast<float>(t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116);
    }
  }
  float f(float t) const {
    const float at = t * steps;
    const int i = static_cast<int>(at);
    const float rest = at - static_cast<float>(i);
    return root[i] + rest * (root[i + 1] - root[i]);
  }
};

}  // namespace

void lab_from_srgb(const std::uint8_t* rgb, float* lab, std::size_t count) {
  static const Tables tables;
  for (std::size_t i = 0; i < count; ++i, rgb += 3, lab += 3) {
    const float r = tables.linear[rgb[0]], g = tables.linear[rgb[1]], b = tables.linear[rgb[2]];
    // XYZ over that of white; each row sums to one but for rounding, which is kept inside the table.
    const float x = tables.f(0.433953f * r + 0.376219f * g + 0.189828f * b),
                y = tables.f(0.212671f * r + 0.715160f * g + 0.072169f * b),
                z = tables.f(0.017758f * r + 0.109477f * g + 0.872766f * b);
    lab[0] = 116 * y - 16;
    lab[1] = 500 * (x - y);
    lab[2] = 200 * (y - z);
  }
}

}  // namespace vitrine
