// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "vitrine/texture.hpp"

namespace vitrine::test {

using Rgb = std::array<int, 3>;
constexpr Rgb kBoard{255, 0, 255};  // a board no garment is mistaken for

/// A rectangular panel, 0.4 m wide and 0.5 m high, photographed on a magenta board.
struct Shot {
  Image rgb, labels;
  Panel panel;
  PanelMesh mesh;
  TextureSource source() const { return {&rgb, &labels, &panel, &mesh}; }
  bool own(int x, int y) const { return *labels.at(x, y) == label_outside; }
};

/// `paint` gives the garment's colour at panel metres; `soft` mixes the edge with the board as a lens does.
inline Shot shoot(Side side, double pixels_per_metre, const std::function<Rgb(const Vec2&)>& paint, bool soft = false,
                  int cells = 10) {
  Shot s;
  const int margin = 20;
  const int width = static_cast<int>(0.4 * pixels_per_metre) + 2 * margin;
  const int height = static_cast<int>(0.5 * pixels_per_metre) + 2 * margin;
  s.rgb = Image(width, height, 3);
  s.labels = Image(width, height, 1);
  s.panel.side = side;
  s.panel.pixel_from_panel = {Vec2(0.5 * (width - 1), height - 1.0 - margin), Vec2(pixels_per_metre, 0),
                              Vec2(0, -pixels_per_metre)};
  const Affine2 metres = s.panel.pixel_from_panel.inverse();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Vec2 p = metres(Vec2(x, y));
      // Distance inside the rectangle [px].
      const double depth = pixels_per_metre * std::min({0.2 - std::abs(p.x()), p.y(), 0.5 - p.y()});
      const bool own = depth >= -1e-6;
      *s.labels.at(x, y) = own ? label_outside : label_background;
      const double share = soft ? std::clamp(0.5 + depth / 3.0, 0.0, 1.0) : (own ? 1.0 : 0.0);
      const Rgb c = paint(p);
      for (int k = 0; k < 3; ++k)
        s.rgb.at(x, y)[k] = static_cast<std::uint8_t>(std::lround(share * c[k] + (1 - share) * kBoard[k]));
    }
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) s.mesh.nodes.emplace_back(-0.2 + 0.4 * i / cells, 0.5 * j / cells);
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (cells + 1) + i);
      const std::uint32_t b = a + 1, c = b + static_cast<std::uint32_t>(cells) + 1, d = c - 1;
      s.mesh.triangles.push_back({a, b, c});
      s.mesh.triangles.push_back({a, c, d});
    }
  s.panel.outline = {Vec2(-0.2, 0)};
  const auto side_of = [&](const Vec2& to) {
    const Vec2 from = s.panel.outline.back();
    for (int i = 1; i <= 25; ++i) s.panel.outline.push_back(from + (to - from) * i / 25.0);
  };
  side_of({0.2, 0});
  side_of({0.2, 0.5});
  side_of({-0.2, 0.5});
  side_of({-0.2, 0});
  s.panel.outline.pop_back();
  for (int e = 0; e < 4; ++e) s.panel.edges.push_back({e, 25 * e, 25 * (e + 1) % 100});
  return s;
}

inline Rgb plain(const Vec2&) {
  return {60, 140, 80};
}
inline Rgb striped(const Vec2& p) {
  return static_cast<int>(std::floor(p.y() / 0.05)) % 2 ? Rgb{170, 40, 50} : Rgb{200, 190, 180};
}

}  // namespace vitrine::test
