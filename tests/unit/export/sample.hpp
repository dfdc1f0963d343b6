// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <string>

#include "vitrine/export.hpp"

namespace vitrine::test {

/// A bent sheet of columns x rows cells without a texture.
inline RenderMesh plain_sheet(const std::string& name, int columns, int rows = 0) {
  if (rows == 0) rows = columns;
  RenderMesh m;
  m.name = name;
  m.colour = {0.5, 0.4, 0.3};
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      const double a = 1.0 * i / columns - 0.5;
      m.positions.emplace_back(std::sin(a), 0.1 + 1.1 * j / rows, std::cos(a));
      m.normals.emplace_back(std::sin(a), 0.0, std::cos(a));
    }
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (columns + 1) + i);
      const std::uint32_t d = a + static_cast<std::uint32_t>(columns) + 1;
      m.triangles.push_back({a, a + 1, d + 1});
      m.triangles.push_back({a, d + 1, d});
    }
  return m;
}

inline Image red_over_blue() {
  Image image(32, 32, 3);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) image.at(x, y)[y < 16 ? 0 : 2] = 220;
  return image;
}

inline RenderMesh textured_sheet(int cells) {
  RenderMesh m = plain_sheet("garment", cells);
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) m.uv.emplace_back(1.0 * i / cells, 1.0 - 1.0 * j / cells);
  m.texture = red_over_blue();
  return m;
}

}  // namespace vitrine::test
