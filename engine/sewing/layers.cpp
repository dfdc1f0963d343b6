// SPDX-License-Identifier: GPL-3.0-or-later
#include "layers.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace vitrine::sewing {
namespace {

constexpr double apart = 0.0015;  // [m] between front and back: two thicknesses of cloth, and no flicker on a screen
constexpr double deepest = 0.02;  // [m] deeper is not drawn back: it would be another fold of the cloth
constexpr double by_seam = 0.04;  // [m] beside a seam the panels always touch: two edges of a mesh for the shop
constexpr double least_facing = 0.3;  // [-] cosine of walls that face away from each other

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

/// Nodes of the cloth that are sewn, or within `by_seam` and at least two edges of one that is.
std::vector<char> near_seams(const Pattern& pattern, const Nodes& nodes) {
  std::uint32_t count = 0;
  for (const auto& n : nodes)
    for (const auto i : n) count = std::max(count, i + 1);
  std::vector<char> in_front(count, 0), near_seam(count, 0);
  for (const auto n : nodes[0]) in_front[n] = 1;
  for (const auto n : nodes[1])
    if (in_front[n]) near_seam[n] = 1;
  const int rings = std::max(2, static_cast<int>(std::ceil(by_seam / mean_edge(pattern))));
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<char> before = near_seam;
    for (std::size_t p = 0; p < 2; ++p)
      for (const Triangle& t : pattern.meshes[p].triangles)
        for (int e = 0; e < 3; ++e)
          if (before[nodes[p][t[e]]]) near_seam[nodes[p][t[(e + 1) % 3]]] = near_seam[nodes[p][t[(e + 2) % 3]]] = 1;
  }
  return near_seam;
}

/// Per mesh node of a panel: the way out of the garment, not normalised.
std::vector<Vec3> ways_out(const PanelMesh& mesh, const std::vector<Vec3>& x, std::size_t panel) {
  std::vector<Vec3> way(x.size(), Vec3::Zero());
  for (const Triangle& t : mesh.triangles) {
    // The back panel's triangles are counter-clockwise seen from the front.
    const Vec3 n = (panel == 1 ? -1.0 : 1.0) * (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
    for (const auto i : t) way[i] += n;
  }
  return way;
}

}  // namespace

std::vector<LayerPair> find_layers(const Pattern& pattern, const Nodes& nodes, const Positions& positions,
                                   double reach) {
  std::vector<LayerPair> pairs;
  const std::vector<char> near_seam = near_seams(pattern, nodes);
  for (std::size_t p = 0; p < 2; ++p) {
    const std::size_t other = 1 - p;
    const PanelMesh& mesh = pattern.meshes[other];
    const auto& x = positions[other];
    const Grid grid(mesh, x, reach);
    const std::vector<Vec3> way = ways_out(pattern.meshes[p], positions[p], p);
    for (std::size_t i = 0; i < positions[p].size(); ++i) {
      if (near_seam[nodes[p][i]]) continue;
      const Vec3& q = positions[p][i];
      LayerPair pair;
      double nearest = reach;
      grid.near(q, [&](int index) {
        const Triangle& t = mesh.triangles[index];
        const Vec3 u = x[t[1]] - x[t[0]], w = x[t[2]] - x[t[0]], d = q - x[t[0]];
        Vec3 normal = u.cross(w);
        const double twice = normal.norm();
        if (twice < 1e-12) return;
        normal /= twice;
        const double s = d.cross(w).dot(normal) / twice, r = u.cross(d).dot(normal) / twice;
        if (s < 0 || r < 0 || s + r > 1) return;
        const Vec3 outwards = other == 1 ? Vec3(-normal) : normal;
        // Opposite walls of the garment face away from each other; a pleat that laps over the seam does not.
        const double facing = -way[i].dot(outwards) / std::max(way[i].norm(), 1e-12);
        if (facing <= least_facing) return;
        const double height = d.dot(outwards);
        if (std::abs(height) >= nearest) return;
        nearest = std::abs(height);
        for (int c = 0; c < 3; ++c) pair.triangle[c] = static_cast<int>(nodes[other][t[c]]);
        pair.share[0] = 1 - s - r, pair.share[1] = s, pair.share[2] = r;
        pair.outwards = outwards;
        pair.height = height;
        // A push that ended at once where a pair leaves the list would throw the node back into it for ever.
        pair.hold = std::min({1.0, 2 - 2 * nearest / reach, (facing - least_facing) / least_facing});
      });
      if (nearest >= reach) continue;
      pair.node = static_cast<int>(nodes[p][i]);
      pairs.push_back(pair);
    }
  }
  return pairs;
}

void Layers::look(const Packed& x) {
  Positions positions(nodes_.size());
  for (std::size_t p = 0; p < nodes_.size(); ++p)
    for (const auto n : nodes_[p]) positions[p].emplace_back(x[4 * n], x[4 * n + 1], x[4 * n + 2]);
  pairs_ = find_layers(pattern_, nodes_, positions, deepest);
}

double Layers::forces(const Packed& x, Packed& force) const {
  double energy = 0;
  for (const LayerPair& pair : pairs_) {
    double over = apart;
    for (int a = 0; a < 3; ++a) {
      double foot = 0;
      for (int c = 0; c < 3; ++c) foot += pair.share[c] * x[4 * pair.triangle[c] + a];
      over += pair.outwards[a] * (x[4 * pair.node + a] - foot);
    }
    if (over <= 0) continue;
    const double k = pair.hold * k_;
    energy += 0.5 * k * over * over;
    for (int a = 0; a < 3; ++a) {
      const double push = k * over * pair.outwards[a];
      force[4 * pair.node + a] -= push;
      for (int c = 0; c < 3; ++c) force[4 * pair.triangle[c] + a] += pair.share[c] * push;
    }
  }
  return energy;
}

void Layers::add_stiffness(std::vector<double>& mass) const {
  for (const LayerPair& pair : pairs_) {
    // A spring's row sums to 2k and counts as k, as for every other spring.
    mass[pair.node] += pair.hold * k_;
    for (int c = 0; c < 3; ++c) mass[pair.triangle[c]] += pair.hold * k_ * pair.share[c];
  }
}

}  // namespace vitrine::sewing
