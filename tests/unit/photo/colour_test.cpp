// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/colour.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace vitrine {
namespace {

/// CIE 15 and IEC 61966-2-1 as they are written, with the matrix of the D65 white point.
std::array<double, 3> lab_by_the_book(const std::array<std::uint8_t, 3>& rgb) {
  std::array<double, 3> light{};
  for (int c = 0; c < 3; ++c) {
    const double v = rgb[c] / 255.0;
    light[c] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  }
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double x = f((0.412453 * light[0] + 0.357580 * light[1] + 0.180423 * light[2]) / 0.950456);
  const double y = f(0.212671 * light[0] + 0.715160 * light[1] + 0.072169 * light[2]);
  const double z = f((0.019334 * light[0] + 0.119193 * light[1] + 0.950227 * light[2]) / 1.088754);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

TEST(Colour, LabIsTheStandardsToAHundredthForEveryFifthValue) {
  for (int r = 0; r < 256; r += 5)
    for (int g = 0; g < 256; g += 5)
      for (int b = 0; b < 256; b += 5) {
        const std::array<std::uint8_t, 3> rgb = {static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g),
                                                 static_cast<std::uint8_t>(b)};
        std::array<float, 3> lab{};
        lab_from_srgb(rgb.data(), lab.data(), 1);
        const std::array<double, 3> wanted = lab_by_the_book(rgb);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(lab[c], wanted[c], 0.01) << r << " " << g << " " << b;
      }
}

TEST(Colour, BlackAndWhiteAreTheEndsOfLightness) {
  const std::array<std::uint8_t, 6> rgb = {0, 0, 0, 255, 255, 255};
  std::array<float, 6> lab{};
  lab_from_srgb(rgb.data(), lab.data(), 2);
  EXPECT_NEAR(lab[0], 0, 1e-3);
  EXPECT_NEAR(lab[3], 100, 1e-3);
  EXPECT_NEAR(lab[4], 0, 1e-2);
  EXPECT_NEAR(lab[5], 0, 1e-2);
}

}  // namespace
}  // namespace vitrine
