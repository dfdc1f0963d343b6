// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vitrine/model/garment_template.hpp"
#include "vitrine/model/image.hpp"
#include "vitrine/model/panel.hpp"

namespace vitrine::fidelity {

/// A silhouette on square pixels, rows top to bottom.
struct Mask {
  Vec2 top_left = Vec2::Zero();  ///< [m]
  double pixel = 0;              ///< [m]
  int width = 0, height = 0;
  std::vector<std::uint8_t> on;  ///< 0 or 1

  Mask() = default;
  Mask(const Vec2& low, const Vec2& high, double pixel);  ///< empty, around a box [m]
  Vec2 centre(int x, int y) const { return top_left + pixel * Vec2(x + 0.5, -(y + 0.5)); }
  bool at(const Vec2& p) const;  ///< false outside
  std::size_t count() const;
};

/// The silhouette turned counter-clockwise about the middle of its box by `angle` [rad].
Mask turned(const Mask& mask, double angle);

/// The silhouette with what lies below `crotch` and to its left swung to the left by `slope` [m per m of depth], and
/// the same to the right: legs wider apart, or closer together where it is below 0.
Mask legs_swung(const Mask& mask, const Vec2& crotch, double slope);

/// A sleeve of one panel: the outline from one end of its root line around the tip to the other.
struct Sleeve {
  std::string name;
  std::vector<int> nodes;     ///< on the outline, in its order
  std::vector<Vec2> polygon;  ///< the same [m]; the root line closes it
};

/// Limbs whose root no other limb shares.
std::vector<Sleeve> sleeves_of(const GarmentTemplate& garment, const Panel& panel);

/// The photo's silhouette on the front panel's metres, without sleeves.
Mask photo_mask(const Image& labels, const Panel& panel, std::span<const Sleeve> sleeves, int rows);

/// The dressed cloth seen from +Z, without sleeves.
Mask worn_mask(const GarmentTemplate& garment, const Pattern& pattern, std::span<const std::vector<Vec3>> positions,
               int rows);

}  // namespace vitrine::fidelity
