// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Masks as a poor cut-out leaves them. Shares are of the diagonal of the garment's box.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "vitrine/model/geometry.hpp"
#include "vitrine/model/image.hpp"

namespace vitrine::test {

struct Box {
  int x0 = 1 << 30, y0 = 1 << 30, x1 = -1, y1 = -1;
  double diagonal() const { return std::hypot(x1 - x0 + 1, y1 - y0 + 1); }
};

inline Box box_of(const Image& labels) {
  Box box;
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x)
      if (*labels.at(x, y)) {
        box.x0 = std::min(box.x0, x);
        box.x1 = std::max(box.x1, x);
        box.y0 = std::min(box.y0, y);
        box.y1 = std::max(box.y1, y);
      }
  return box;
}

/// Numbers in [-1, 1], the same everywhere.
class Rolls {
 public:
  explicit Rolls(std::uint32_t seed) : state_(seed * 2654435761u + 88172645u) {}
  double roll() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return static_cast<double>(state_) / 2147483647.5 - 1;
  }

 private:
  std::uint32_t state_;
};

/// Moves the outline in and out by seeded noise of standard deviation `amount`, smooth over `grain`: each pixel near it
/// is kept or not by its distance to the outline against the noise there.
inline Image roughened(const Image& labels, double amount, double grain, std::uint32_t seed) {
  const double diagonal = box_of(labels).diagonal(), deviation = amount * diagonal;
  const int cell = std::max(2, static_cast<int>(2 * grain * diagonal)), reach = static_cast<int>(3 * deviation) + 2;
  const int columns = labels.width / cell + 2, rows = labels.height / cell + 2;
  std::vector<double> lattice(static_cast<std::size_t>(columns) * rows);
  Rolls rolls(seed);
  for (double& value : lattice) value = (rolls.roll() + rolls.roll() + rolls.roll()) * 1.5;  // about 1 when blended
  Image result = labels;
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x) {
      const bool inside = *labels.at(x, y) != label_background;
      int nearest = reach * reach;
      for (int v = std::max(0, y - reach); v <= std::min(labels.height - 1, y + reach); ++v)
        for (int u = std::max(0, x - reach); u <= std::min(labels.width - 1, x + reach); ++u)
          if ((*labels.at(u, v) != label_background) != inside)
            nearest = std::min(nearest, (u - x) * (u - x) + (v - y) * (v - y));
      if (nearest >= reach * reach) continue;
      const double distance = (inside ? 1 : -1) * (std::sqrt(nearest) - 0.5);
      const double fx = static_cast<double>(x) / cell, fy = static_cast<double>(y) / cell;
      const int cx = static_cast<int>(fx), cy = static_cast<int>(fy);
      const double* at = &lattice[static_cast<std::size_t>(cy) * columns + cx];
      const double a = at[0] + (fx - cx) * (at[1] - at[0]);
      const double b = at[columns] + (fx - cx) * (at[columns + 1] - at[columns]);
      *result.at(x, y) = distance + deviation * (a + (fy - cy) * (b - a)) > 0 ? label_outside : label_background;
    }
  return result;
}

/// Cuts `count` round bites of radius `size` into the outline.
inline Image bitten(const Image& labels, double size, int count, std::uint32_t seed) {
  std::vector<std::pair<int, int>> outline;
  for (int y = 1; y + 1 < labels.height; ++y)
    for (int x = 1; x + 1 < labels.width; ++x)
      if (*labels.at(x, y) &&
          !(*labels.at(x - 1, y) && *labels.at(x + 1, y) && *labels.at(x, y - 1) && *labels.at(x, y + 1)))
        outline.emplace_back(x, y);
  const double radius = size * box_of(labels).diagonal();
  Image result = labels;
  Rolls rolls(seed);
  for (int k = 0; k < count; ++k) {
    const double at = (rolls.roll() + 1) / 2 * static_cast<double>(outline.size() - 1);
    const auto [cx, cy] = outline[static_cast<std::size_t>(at)];
    for (int y = 0; y < labels.height; ++y)
      for (int x = 0; x < labels.width; ++x)
        if (std::hypot(x - cx, y - cy) <= radius) *result.at(x, y) = label_background;
  }
  return result;
}

}  // namespace vitrine::test
