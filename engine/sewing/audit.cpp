// SPDX-License-Identifier: GPL-3.0-or-later
#include "audit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace vitrine::sewing {
namespace {

constexpr double too_close = 0.001;      // [m]
constexpr double crossing_reach = 0.01;  // [m] deeper is not looked for: it would be another fold of the cloth

struct Cell {
  std::int64_t key;
  int triangle;
  bool operator<(const Cell& o) const { return key != o.key ? key < o.key : triangle < o.triangle; }
};

/// Triangles of one panel in a sorted hash grid.
class Grid {
 public:
  Grid(const PanelMesh& mesh, const std::vector<Vec3>& x, double margin) {
    lo_ = x.front();
    Vec3 hi = lo_;
    for (const Vec3& p : x) lo_ = lo_.cwiseMin(p), hi = hi.cwiseMax(p);
    double longest = 0;
    for (const Triangle& t : mesh.triangles)
      for (int e = 0; e < 3; ++e) longest = std::max(longest, (x[t[e]] - x[t[(e + 1) % 3]]).norm());
    // Bounded both ways: neither more cells than a garment needs nor cells that a stretched edge makes useless.
    cell_ = std::max({longest, margin, (hi - lo_).maxCoeff() / 500});
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      Vec3 from = x[mesh.triangles[i][0]], to = from;
      for (const auto n : mesh.triangles[i]) from = from.cwiseMin(x[n]), to = to.cwiseMax(x[n]);
      from.array() -= margin, to.array() += margin;
      const auto a = index(from), b = index(to);
      for (std::int64_t z = a[2]; z <= b[2]; ++z)
        for (std::int64_t y = a[1]; y <= b[1]; ++y)
          for (std::int64_t k = a[0]; k <= b[0]; ++k) cells_.push_back({key(k, y, z), static_cast<int>(i)});
    }
    std::sort(cells_.begin(), cells_.end());
  }

  template <class Visit>
  void near(const Vec3& p, Visit&& visit) const {
    const auto i = index(p);
    const Cell want{key(i[0], i[1], i[2]), -1};
    for (auto c = std::lower_bound(cells_.begin(), cells_.end(), want); c != cells_.end() && c->key == want.key; ++c)
      visit(c->triangle);
  }

 private:
  std::array<std::int64_t, 3> index(const Vec3& p) const {
    std::array<std::int64_t, 3> i;
    for (int a = 0; a < 3; ++a) i[a] = static_cast<std::int64_t>(std::floor((p[a] - lo_[a]) / cell_)) + 2;
    return i;
  }
  static std::int64_t key(std::int64_t x, std::int64_t y, std::int64_t z) { return (z * 4096 + y) * 4096 + x; }

  Vec3 lo_;
  double cell_ = 1;
  std::vector<Cell> cells_;
};

}  // namespace

Strains measure_strain(const Pattern& pattern, const Positions& positions) {
  std::vector<double> strain;
  for (std::size_t p = 0; p < pattern.meshes.size(); ++p) {
    const PanelMesh& m = pattern.meshes[p];
    for (const Triangle& t : m.triangles)
      for (int e = 0; e < 3; ++e) {
        const auto a = t[e], b = t[(e + 1) % 3];
        const double rest = (m.nodes[a] - m.nodes[b]).norm();
        if (rest < 1e-9) continue;
        strain.push_back((positions[p][a] - positions[p][b]).norm() / rest - 1);
      }
  }
  Strains s;
  if (strain.empty()) return s;
  const auto p99 = [&] {
    std::sort(strain.begin(), strain.end());
    return strain[static_cast<std::size_t>(0.99 * static_cast<double>(strain.size() - 1))];
  };
  s.stretch_p99 = p99();
  for (double& e : strain) e = std::abs(e);
  s.p99 = p99();
  s.most = strain.back();
  return s;
}

double measure_penetration(const Pattern& pattern, const Positions& positions, const DistanceField& body) {
  double deepest = 0;
  for (std::size_t p = 0; p < positions.size(); ++p) {
    const auto& x = positions[p];
    for (const Vec3& q : x) deepest = std::max(deepest, -body.distance(q));
    for (const Triangle& t : pattern.meshes[p].triangles)
      deepest = std::max(deepest, -body.distance((x[t[0]] + x[t[1]] + x[t[2]]) / 3));
  }
  return deepest;
}

SelfContact detect_self_contact(const Pattern& pattern, const Nodes& nodes, const Positions& positions) {
  SelfContact found;
  // Cloth next to a seam always touches the other panel: nodes within two edges of a sewn node are left out.
  std::uint32_t count = 0;
  for (const auto& n : nodes)
    for (const auto i : n) count = std::max(count, i + 1);
  std::vector<char> in_front(count, 0), near_seam(count, 0);
  for (const auto n : nodes[0]) in_front[n] = 1;
  for (const auto n : nodes[1])
    if (in_front[n]) near_seam[n] = 1;
  for (int ring = 0; ring < 2; ++ring) {
    const std::vector<char> before = near_seam;
    for (std::size_t p = 0; p < 2; ++p)
      for (const Triangle& t : pattern.meshes[p].triangles)
        for (int e = 0; e < 3; ++e)
          if (before[nodes[p][t[e]]]) near_seam[nodes[p][t[(e + 1) % 3]]] = near_seam[nodes[p][t[(e + 2) % 3]]] = 1;
  }
  for (std::size_t p = 0; p < 2; ++p) {
    const std::size_t other = 1 - p;
    const PanelMesh& mesh = pattern.meshes[other];
    const auto& x = positions[other];
    const Grid grid(mesh, x, crossing_reach);
    for (std::size_t i = 0; i < positions[p].size(); ++i) {
      if (near_seam[nodes[p][i]]) continue;
      const Vec3& q = positions[p][i];
      double nearest = crossing_reach, height = 0;
      grid.near(q, [&](int index) {
        const Triangle& t = mesh.triangles[index];
        const Vec3 u = x[t[1]] - x[t[0]], w = x[t[2]] - x[t[0]], d = q - x[t[0]];
        Vec3 normal = u.cross(w);
        const double twice = normal.norm();
        if (twice < 1e-12) return;
        normal /= twice;
        const double s = d.cross(w).dot(normal) / twice, r = u.cross(d).dot(normal) / twice;
        if (s < 0 || r < 0 || s + r > 1) return;
        const double h = d.dot(normal) * (other == 1 ? -1 : 1);  // above the other panel's outside
        if (std::abs(h) < nearest) nearest = std::abs(h), height = h;
      });
      if (nearest >= crossing_reach) continue;
      if (nearest < too_close) ++found.close;
      if (height > 0) {
        ++found.crossed;
        found.depth = std::max(found.depth, height);
      }
    }
  }
  return found;
}

}  // namespace vitrine::sewing
