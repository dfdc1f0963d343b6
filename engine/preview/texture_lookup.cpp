// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture_lookup.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace vitrine {
namespace {

/// Texels per metre of surface, over the whole mesh.
double density(const RenderMesh& mesh) {
  double surface = 0, texels = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[1]] - mesh.positions[t[0]], b = mesh.positions[t[2]] - mesh.positions[t[0]];
    const Vec2 c = mesh.uv[t[1]] - mesh.uv[t[0]], d = mesh.uv[t[2]] - mesh.uv[t[0]];
    surface += a.cross(b).norm();
    texels += std::abs(c.x() * d.y() - c.y() * d.x());
  }
  return surface > 0 ? std::sqrt(texels / surface * mesh.texture.width * mesh.texture.height) : 0.0;
}

}  // namespace

float srgb_to_linear(std::uint8_t v) {
  static const auto table = [] {
    std::array<float, 256> t{};
    for (int i = 0; i < 256; ++i) {
      const double c = i / 255.0;
      t[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return t;
  }();
  return table[v];
}

namespace {

double encoded(double linear) {
  return 255.0 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

/// A power for each channel of each pixel costs as much as tracing it: the rounded code of any value is that of its
/// cell in a table, or one of the next few.
struct CodeTable {
  static constexpr int cells = 4096;
  std::array<std::uint8_t, cells> code{};  // at the cell's lower end
  std::array<double, 256> upper{};         // the least value whose code is larger
  CodeTable() {
    for (int i = 0; i < cells; ++i) code[i] = static_cast<std::uint8_t>(std::lround(encoded(i / double{cells})));
    for (int c = 0; c < 255; ++c) {
      double low = 0, high = 1;
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (std::lround(encoded(middle)) > c ? high : low) = middle;
      }
      upper[c] = high;
    }
    upper[255] = 2;
  }
};

}  // namespace

std::uint8_t linear_to_srgb(double v) {
  static const CodeTable table;
  const double c = std::clamp(v, 0.0, 1.0);
  std::uint8_t code = table.code[std::min(CodeTable::cells - 1, static_cast<int>(c * CodeTable::cells))];
  while (c >= table.upper[code]) ++code;
  return code;
}

TextureLookup::TextureLookup(const RenderMesh& mesh, double footprint)
    : plain_(static_cast<float>(mesh.colour[0]), static_cast<float>(mesh.colour[1]),
             static_cast<float>(mesh.colour[2])) {
  if (mesh.texture.empty()) return;
  const Image& image = mesh.texture;
  const double texels = density(mesh) * footprint;
  int step = 1;
  while (texels / step > 1.5 && step * 2 <= std::min(image.width, image.height)) step *= 2;
  width_ = image.width / step;
  height_ = image.height / step;
  texels_.assign(static_cast<std::size_t>(width_) * height_, Colour::Zero());
  const float share = 1.0F / static_cast<float>(step * step);
  for (int y = 0; y < height_ * step; ++y)
    for (int x = 0; x < width_ * step; ++x) {
      const std::uint8_t* p = image.at(x, y);
      texels_[static_cast<std::size_t>(y / step) * width_ + x / step] +=
          share * Colour(srgb_to_linear(p[0]), srgb_to_linear(p[1]), srgb_to_linear(p[2]));
    }
}

Colour TextureLookup::at(double u, double v) const {
  if (texels_.empty()) return plain_;
  const double x = std::clamp(u * width_ - 0.5, 0.0, width_ - 1.0),
               y = std::clamp(v * height_ - 0.5, 0.0, height_ - 1.0);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, width_ - 1), y1 = std::min(y0 + 1, height_ - 1);
  const float fx = static_cast<float>(x - x0), fy = static_cast<float>(y - y0);
  const auto texel = [&](int i, int j) -> const Colour& { return texels_[static_cast<std::size_t>(j) * width_ + i]; };
  const Colour a = texel(x0, y0) + fx * (texel(x1, y0) - texel(x0, y0));
  const Colour b = texel(x0, y1) + fx * (texel(x1, y1) - texel(x0, y1));
  return a + fy * (b - a);
}

}  // namespace vitrine
