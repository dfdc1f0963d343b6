// SPDX-License-Identifier: GPL-3.0-or-later
#include "commerce_uv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

namespace vitrine {
namespace {

constexpr int kLargestGutter = 64;  // [px] measured no further
constexpr int kDark = 30, kBright = 243;

/// Charts by shared vertices.
class Charts {
 public:
  explicit Charts(std::size_t vertices) : parent_(vertices) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t of(std::uint32_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[of(a)] = of(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Calls `visit(x, y)` for each texel whose centre lies in the triangle; a centre on an edge belongs to one side only
/// (top-left rule), so that neighbours never share one.
template <class F>
void each_texel(const std::array<Vec2, 3>& p, int width, int height, F&& visit) {
  const double left = std::min({p[0].x(), p[1].x(), p[2].x()}), right = std::max({p[0].x(), p[1].x(), p[2].x()});
  const double top = std::min({p[0].y(), p[1].y(), p[2].y()}), bottom = std::max({p[0].y(), p[1].y(), p[2].y()});
  std::array<Vec2, 3> q = p;
  if (twice_area(q[0], q[1], q[2]) < 0) std::swap(q[1], q[2]);
  struct Edge {
    Vec2 a, way;
    bool turned;
  };
  std::array<Edge, 3> edges;
  for (int k = 0; k < 3; ++k) {
    // Both triangles of an edge see the very same numbers, with the sign turned.
    Vec2 a = q[k], b = q[(k + 1) % 3];
    const bool turned = std::lexicographical_compare(b.data(), b.data() + 2, a.data(), a.data() + 2);
    if (turned) std::swap(a, b);
    edges[k] = {a, b - a, turned};
  }
  for (int y = std::max(0, static_cast<int>(std::floor(top))); y <= std::min(height - 1, static_cast<int>(bottom)); ++y)
    for (int x = std::max(0, static_cast<int>(std::floor(left))); x <= std::min(width - 1, static_cast<int>(right));
         ++x) {
      bool inside = true;
      for (const Edge& e : edges) {
        const double side = e.way.x() * (y + 0.5 - e.a.y()) - e.way.y() * (x + 0.5 - e.a.x());
        inside &= e.turned ? side <= 0 : side > 0;
      }
      if (inside) visit(x, y);
    }
}

/// Least distance [px, whole] at which texels of two charts, or of a chart and the border, come together.
int find_gutter(std::vector<int> owner, int width, int height) {
  // Breadth first from the rims of all charts at once; where two fronts meet, their steps add up.
  constexpr std::array<std::pair<int, int>, 4> around{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  std::vector<std::uint8_t> step(owner.size(), 0);
  std::vector<int> front, next;
  int least = 2 * kLargestGutter;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int i = y * width + x, own = owner[i];
      if (own < 0) continue;
      const int border = std::min(std::min(x, width - 1 - x), std::min(y, height - 1 - y));
      least = std::min(least, border);
      // What lies among its own has nothing to meet.
      if (border == 0 || owner[i - 1] != own || owner[i + 1] != own || owner[i - width] != own ||
          owner[i + width] != own)
        front.push_back(i);
    }
  // Fronts that have not met after so many steps are no closer than twice as many.
  for (int distance = 1; !front.empty() && 2 * (distance - 1) < least; ++distance) {
    next.clear();
    for (const int i : front) {
      const int x = i % width, y = i / width;
      for (const auto& [dx, dy] : around) {
        const int u = x + dx, v = y + dy;
        if (u < 0 || v < 0 || u >= width || v >= height) continue;
        const int n = v * width + u;
        if (owner[n] < 0) {
          owner[n] = owner[i];
          step[n] = static_cast<std::uint8_t>(distance);
          next.push_back(n);
        } else if (owner[n] != owner[i]) {
          least = std::min(least, step[n] + step[i]);
        }
      }
    }
    std::swap(front, next);
  }
  return least;
}

}  // namespace

UvFigures measure_uv(const std::vector<Vec2>& uv, const std::vector<Triangle>& triangles, const Image& texture) {
  UvFigures f;
  const int width = texture.width, height = texture.height;
  if (uv.empty() || triangles.empty() || width <= 0 || height <= 0) return f;
  f.low = 1e30;
  f.high = -1e30;
  for (const Vec2& p : uv) {
    f.low = std::min(f.low, p.minCoeff());
    f.high = std::max(f.high, p.maxCoeff());
  }
  Charts charts(uv.size());
  for (const Triangle& t : triangles) {
    charts.join(t[0], t[1]);
    charts.join(t[1], t[2]);
  }
  std::vector<std::uint8_t> count(static_cast<std::size_t>(width) * height, 0);  // up to 2
  std::vector<int> owner(count.size(), -1);
  for (const Triangle& t : triangles) {
    // v runs down in glTF, so a triangle that is counter-clockwise on the surface is clockwise in (u, v).
    if (twice_area(uv[t[0]], uv[t[1]], uv[t[2]]) > 0) ++f.inverted;
    std::array<Vec2, 3> p;
    for (int k = 0; k < 3; ++k) p[k] = uv[t[k]].cwiseProduct(Vec2(width, height));
    const int chart = static_cast<int>(charts.of(t[0]));
    each_texel(p, width, height, [&](int x, int y) {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      count[i] = count[i] == 0 ? 1 : 2;
      owner[i] = chart;
    });
  }
  std::size_t covered = 0, twice = 0, dark = 0, bright = 0;
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (count[i] == 0) continue;
    ++covered;
    twice += count[i] > 1;
    const std::uint8_t* c = &texture.data[3 * i];
    const int top = std::max({c[0], c[1], c[2]});
    dark += top < kDark;
    bright += top > kBright;
  }
  if (covered > 0) {
    f.overlap_share = static_cast<double>(twice) / static_cast<double>(covered);
    f.dark_share = static_cast<double>(dark) / static_cast<double>(covered);
    f.bright_share = static_cast<double>(bright) / static_cast<double>(covered);
  }
  std::vector<std::uint32_t> roots;
  for (const Triangle& t : triangles) roots.push_back(charts.of(t[0]));
  std::sort(roots.begin(), roots.end());
  f.charts = static_cast<int>(std::unique(roots.begin(), roots.end()) - roots.begin());
  f.gutter = find_gutter(std::move(owner), width, height);
  return f;
}

}  // namespace vitrine
