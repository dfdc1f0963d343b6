// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Everything a mesh of a panel has to be, whatever its quality.
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <utility>

#include "random_panels.hpp"
#include "vitrine/mesh.hpp"

namespace vitrine::test {

inline double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

inline double area(const Outline& p) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) twice += twice_area(p[0], p[i], p[i + 1]);
  return 0.5 * twice;
}

/// The boundary as one list: who follows whom with the cloth on the left, whatever way round the loops are given.
struct Rim {
  Outline nodes;
  std::vector<std::uint32_t> next, previous;
  double area = 0;

  Rim(const Outline& outline, const std::vector<Outline>& holes) {
    add(outline, false);
    for (const Outline& hole : holes) add(hole, true);
  }
  void add(const Outline& loop, bool hole) {
    const auto first = static_cast<std::uint32_t>(nodes.size()), n = static_cast<std::uint32_t>(loop.size());
    const double signed_area = test::area(loop);
    area += hole ? -std::abs(signed_area) : std::abs(signed_area);
    nodes.insert(nodes.end(), loop.begin(), loop.end());
    for (std::uint32_t i = 0; i < n; ++i) {
      next.push_back(first + (i + 1) % n);
      previous.push_back(first + (i + n - 1) % n);
    }
    if ((signed_area < 0) != hole)
      for (std::uint32_t i = first; i < first + n; ++i) std::swap(next[i], previous[i]);
  }
  /// Inner angle at a boundary node [degrees].
  double corner(std::uint32_t i) const { return angle(nodes[i], nodes[next[i]], nodes[previous[i]]); }
  static double angle(const Vec2& at, const Vec2& from, const Vec2& to) {
    const Vec2 u = from - at, v = to - at;
    const double a = std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v)) * 180 / std::numbers::pi;
    return a < 0 ? a + 360 : a;
  }
};

inline void expect_valid(const Outline& outline, const PanelMesh& mesh, const std::vector<Outline>& holes = {}) {
  const Rim rim(outline, holes);
  const std::size_t n = rim.nodes.size();
  ASSERT_GE(mesh.nodes.size(), n);
  ASSERT_EQ(std::memcmp(mesh.nodes.data(), rim.nodes.data(), n * sizeof(Vec2)), 0) << "the boundary was moved";
  double sum = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;  // directed edges
  std::vector<char> used(mesh.nodes.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    const double twice = twice_area(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]]);
    ASSERT_GT(twice, 0) << "a triangle is flat or clockwise";
    sum += 0.5 * twice;
    for (int k = 0; k < 3; ++k) {
      ASSERT_EQ(++uses[std::pair(t[k], t[(k + 1) % 3])], 1) << "two triangles on one side of an edge";
      used[t[k]] = 1;
    }
    const Vec2 middle = (mesh.nodes[t[0]] + mesh.nodes[t[1]] + mesh.nodes[t[2]]) / 3;
    ASSERT_TRUE(inside(outline, middle)) << "a triangle lies outside";
    for (const Outline& hole : holes) ASSERT_FALSE(inside(hole, middle)) << "a triangle lies in a hole";
  }
  EXPECT_NEAR(sum, rim.area, 1e-11 * rim.area);
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0) << "a node belongs to no triangle";

  std::size_t border = 0;
  for (const auto& [edge, count] : uses) {
    if (uses.count({edge.second, edge.first})) continue;
    ++border;
    EXPECT_TRUE(edge.first < n && edge.second == rim.next[edge.first]) << "the border leaves the outline";
  }
  EXPECT_EQ(border, n) << "a boundary segment is no edge";
  const auto edges = static_cast<long>(border + (uses.size() - border) / 2);
  EXPECT_EQ(static_cast<long>(mesh.nodes.size()) - edges + static_cast<long>(mesh.triangles.size()),
            1 - static_cast<long>(holes.size()))
      << "Euler characteristic";
}

/// The smallest angle [degrees] of the triangles that do not lie in a corner of the boundary sharper than `corner`.
inline double smallest_angle(const Rim& rim, const PanelMesh& mesh, double corner) {
  double smallest = 180;
  for (const Triangle& t : mesh.triangles) {
    bool excused = false;
    double least = 180;
    for (int k = 0; k < 3; ++k) {
      excused |= t[k] < rim.nodes.size() && rim.corner(t[k]) < corner;
      least = std::min(least, Rim::angle(mesh.nodes[t[k]], mesh.nodes[t[(k + 1) % 3]], mesh.nodes[t[(k + 2) % 3]]));
    }
    if (!excused) smallest = std::min(smallest, least);
  }
  return smallest;
}

}  // namespace vitrine::test
