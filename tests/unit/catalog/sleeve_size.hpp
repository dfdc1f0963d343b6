// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <string>

#include "photo_maker.hpp"

/// What a tape says of a sleeve in a photo [cm]: flat widths square to the sleeve, counted in the pixels of the true
/// labels, and lengths between the true landmarks.
struct SleeveSize {
  double armpit = 0, elbow = 0, cuff = 0;  ///< widths
  double under = 0;                        ///< armpit to cuff
  double upper = 0;                        ///< shoulder to cuff
};

inline std::array<SleeveSize, 2> sleeves_of(const vitrine::support::MadePhoto& photo) {
  using vitrine::Vec2;
  std::array<SleeveSize, 2> sizes;
  for (int i = 0; i < 2; ++i) {
    const auto at = [&](const char* name) -> Vec2 {
      return photo.landmarks.at(name + std::string(i == 0 ? "_left" : "_right"));
    };
    const Vec2 upper = at("cuff_upper"), lower = at("cuff_lower"), armpit = at("armpit");
    const Vec2 outward = (upper - lower).normalized();
    const auto on_garment = [&](const Vec2& p) {
      const long x = std::lround(p.x()), y = std::lround(p.y());
      return x >= 0 && y >= 0 && x < photo.labels.width && y < photo.labels.height &&
             *photo.labels.at(static_cast<int>(x), static_cast<int>(y)) != vitrine::label_background;
    };
    const auto pixels = [&](Vec2 p, const Vec2& step) {
      double n = 0;
      for (; on_garment(p); p += step) n += step.norm();
      return n;
    };
    const double px = photo.pixels_per_cm;
    // A little within the sleeve: the armpit's own pixel may be the board's.
    sizes[i].armpit = (2 + pixels(armpit + 2 * outward, 0.25 * outward)) / px;
    const Vec2 elbow = 0.5 * (armpit + 0.5 * (upper + lower)) + 0.25 * sizes[i].armpit * px * outward;
    sizes[i].elbow = (pixels(elbow, 0.25 * outward) + pixels(elbow, -0.25 * outward)) / px;
    sizes[i].cuff = (upper - lower).norm() / px;
    sizes[i].under = (lower - armpit).norm() / px;
    sizes[i].upper = (upper - at("shoulder")).norm() / px;
  }
  return sizes;
}
