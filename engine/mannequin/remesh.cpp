// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace vitrine::body {

namespace {

using Index = std::uint32_t;
constexpr std::size_t most_split_triangles = 100'000;  ///< several times what a body has

class Remesher {
 public:
  Remesher(TriMesh& mesh, const Surface& surface) : v_(mesh.vertices), t_(mesh.triangles), surface_(surface) {}

  void round() {
    link();
    split();
    link();
    collapse();
    compact();
    link();
    flip();
    link();
    slide();
  }

  /// Secant steps along the vertex normal: the field's slope is 1 save where two parts blend.
  void project(int steps) {
    std::vector<Vec3> normal(v_.size(), Vec3::Zero());
    for (const Triangle& t : t_)
      for (Index corner : t) normal[corner] += cross(t[0], t[1], t[2]);
    for (Index i = 0; i < v_.size(); ++i) {
      const Vec3 n = normal[i].normalized();
      double slope = 1, before = 0, moved = 0;
      for (int step = 0; step < steps; ++step) {
        const double d = surface_.distance(v_[i]);
        if (std::abs(d) < 1e-6) break;
        if (std::abs(moved) > 1e-6) slope = std::clamp((before - d) / moved, 0.5, 2.0);
        before = d;
        moved = std::clamp(d / slope, -0.005, 0.005);
        v_[i] -= moved * n;
      }
    }
  }

 private:
  static bool dead(const Triangle& t) { return t[0] == t[1]; }
  Vec3 cross(Index a, Index b, Index c) const { return (v_[b] - v_[a]).cross(v_[c] - v_[a]); }
  double wanted(Index a, Index b) const { return 0.5 * (size_[a] + size_[b]); }

  void link() {
    around_.assign(v_.size(), {});
    size_.resize(v_.size());
    for (Index i = 0; i < v_.size(); ++i) size_[i] = surface_.edge(v_[i]);
    for (Index i = 0; i < t_.size(); ++i)
      for (Index corner : t_[i]) around_[corner].push_back(i);
  }

  std::vector<Index> neighbours(Index a) const {
    std::vector<Index> result;
    for (Index i : around_[a])
      for (Index corner : t_[i])
        if (corner != a) result.push_back(corner);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  /// The two triangles on the edge a-b, the first walking it from a to b.
  bool edge_triangles(Index a, Index b, Index found[2], Index opposite[2]) const {
    bool have[2] = {false, false};
    for (Index i : around_[a]) {
      const Triangle& t = t_[i];
      if (dead(t)) continue;
      for (int k = 0; k < 3; ++k) {
        const int way = t[k] == a && t[(k + 1) % 3] == b ? 0 : t[k] == b && t[(k + 1) % 3] == a ? 1 : 2;
        if (way == 2) continue;
        found[way] = i;
        opposite[way] = t[(k + 2) % 3];
        have[way] = true;
      }
    }
    return have[0] && have[1];
  }

  void split() {
    const std::size_t count = t_.size();
    // A solid that is not one (parts far apart, vertices that cannot reach it) would be cut up for ever.
    if (count > most_split_triangles) return;
    for (Index i = 0; i < count; ++i)
      for (int k = 0; k < 3; ++k) {
        const Index a = t_[i][k], b = t_[i][(k + 1) % 3];
        if (a > b || (v_[a] - v_[b]).norm() < 1.45 * wanted(a, b)) continue;
        Index tri[2], tip[2];
        if (!edge_triangles(a, b, tri, tip)) continue;
        const Index m = static_cast<Index>(v_.size());
        v_.push_back(0.5 * (v_[a] + v_[b]));
        size_.push_back(wanted(a, b));
        around_.emplace_back();
        const Index first = static_cast<Index>(t_.size());
        t_[tri[0]] = {a, m, tip[0]};
        t_.push_back({m, b, tip[0]});
        t_[tri[1]] = {m, a, tip[1]};
        t_.push_back({b, m, tip[1]});
        const auto leave = [&](Index vertex, Index triangle) {
          auto& list = around_[vertex];
          list.erase(std::find(list.begin(), list.end(), triangle));
        };
        leave(b, tri[0]);
        leave(b, tri[1]);
        around_[b].insert(around_[b].end(), {first, first + 1});
        around_[tip[0]].push_back(first);
        around_[tip[1]].push_back(first + 1);
        around_[m] = {tri[0], first, tri[1], first + 1};
        break;
      }
  }

  void collapse() {
    for (Index i = 0; i < t_.size(); ++i) {
      for (int k = 0; k < 3 && !dead(t_[i]); ++k) {
        const Index a = t_[i][k], b = t_[i][(k + 1) % 3];
        if ((v_[a] - v_[b]).norm() < 0.76 * wanted(a, b)) try_collapse(a, b);
      }
    }
  }

  void try_collapse(Index a, Index b) {
    const std::vector<Index> na = neighbours(a), nb = neighbours(b);
    std::vector<Index> common;
    std::set_intersection(na.begin(), na.end(), nb.begin(), nb.end(), std::back_inserter(common));
    // Link condition: exactly the two tips are shared, or the surface would pinch.
    if (common.size() != 2 || na.size() + nb.size() > 16) return;
    for (Index c : common)
      if (neighbours(c).size() <= 3) return;
    const Vec3 middle = 0.5 * (v_[a] + v_[b]);
    for (int end = 0; end < 2; ++end)
      for (Index c : end == 0 ? na : nb)
        if (c != a && c != b && (v_[c] - middle).norm() > 1.4 * wanted(a, c)) return;
    for (int end = 0; end < 2; ++end) {
      const Index from = end == 0 ? a : b, other = end == 0 ? b : a;
      for (Index i : around_[from]) {
        const Triangle& t = t_[i];
        if (dead(t) || t[0] == other || t[1] == other || t[2] == other) continue;
        const Vec3 before = cross(t[0], t[1], t[2]);
        Vec3 p[3];
        for (int k = 0; k < 3; ++k) p[k] = t[k] == from ? middle : v_[t[k]];
        const Vec3 after = (p[1] - p[0]).cross(p[2] - p[0]);
        if (before.dot(after) < 0.5 * before.norm() * after.norm() || after.norm() < 1e-10) return;
      }
    }
    v_[a] = middle;
    for (Index i : around_[b]) {
      Triangle& t = t_[i];
      if (dead(t)) continue;
      if (t[0] == a || t[1] == a || t[2] == a) {
        for (Index corner : t)
          if (corner != b) {
            auto& list = around_[corner];
            list.erase(std::remove(list.begin(), list.end(), i), list.end());
          }
        t = {0, 0, 0};
      } else {
        for (Index& corner : t)
          if (corner == b) corner = a;
        around_[a].push_back(i);
      }
    }
    around_[b].clear();
  }

  void compact() {
    constexpr Index none = 0xffffffffU;
    std::vector<Index> number(v_.size(), none);
    std::vector<Vec3> kept;
    std::vector<Triangle> triangles;
    for (const Triangle& t : t_) {
      if (dead(t)) continue;
      Triangle out{};
      for (int k = 0; k < 3; ++k) {
        if (number[t[k]] == none) {
          number[t[k]] = static_cast<Index>(kept.size());
          kept.push_back(v_[t[k]]);
        }
        out[k] = number[t[k]];
      }
      triangles.push_back(out);
    }
    v_ = std::move(kept);
    t_ = std::move(triangles);
  }

  void flip() {
    const auto off = [](std::size_t valence) { return std::abs(static_cast<int>(valence) - 6); };
    for (Index i = 0; i < t_.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const Index a = t_[i][k], b = t_[i][(k + 1) % 3];
        if (a > b) continue;
        Index tri[2], tip[2];
        if (!edge_triangles(a, b, tri, tip)) continue;
        const Index c = tip[0], d = tip[1];
        const std::size_t va = around_[a].size(), vb = around_[b].size(), vc = around_[c].size(),
                          vd = around_[d].size();
        if (va <= 4 || vb <= 4) continue;
        const int gain = off(va) + off(vb) + off(vc) + off(vd) - off(va - 1) - off(vb - 1) - off(vc + 1) - off(vd + 1);
        if (gain <= 0) continue;
        const std::vector<Index> around_c = neighbours(c);
        if (std::binary_search(around_c.begin(), around_c.end(), d)) continue;
        const Vec3 n0 = cross(a, b, c), n1 = cross(b, a, d), m0 = cross(c, d, b), m1 = cross(d, c, a);
        const Vec3 n = (n0 + n1).normalized();
        if (m0.dot(n) < 0.8 * m0.norm() || m1.dot(n) < 0.8 * m1.norm() || std::min(m0.norm(), m1.norm()) < 1e-8)
          continue;
        t_[tri[0]] = {c, d, b};
        t_[tri[1]] = {d, c, a};
        const auto leave = [&](Index vertex, Index triangle) {
          auto& list = around_[vertex];
          list.erase(std::find(list.begin(), list.end(), triangle));
        };
        leave(a, tri[0]);
        leave(b, tri[1]);
        around_[c].push_back(tri[1]);
        around_[d].push_back(tri[0]);
        break;
      }
  }

  void slide() {
    std::vector<Vec3> moved(v_.size());
    for (Index i = 0; i < v_.size(); ++i) {
      Vec3 sum = Vec3::Zero(), normal = Vec3::Zero();
      double weight = 0;
      for (Index t : around_[i]) {
        const Vec3 n = cross(t_[t][0], t_[t][1], t_[t][2]);
        normal += n;
        const double area = n.norm();
        sum += area * (v_[t_[t][0]] + v_[t_[t][1]] + v_[t_[t][2]]) / 3;
        weight += area;
      }
      normal.normalize();
      const Vec3 step = weight > 0 ? Vec3(sum / weight - v_[i]) : Vec3(Vec3::Zero());
      moved[i] = v_[i] + 0.8 * (step - normal.dot(step) * normal);
    }
    v_ = std::move(moved);
    project(2);
  }

  std::vector<Vec3>& v_;
  std::vector<Triangle>& t_;
  const Surface& surface_;
  std::vector<std::vector<Index>> around_;
  std::vector<double> size_;
};

}  // namespace

void remesh(TriMesh& mesh, const Surface& surface, int rounds) {
  Remesher work(mesh, surface);
  for (int i = 0; i < rounds; ++i) work.round();
  work.project(5);
}

void settle(TriMesh& mesh, const Surface& surface) {
  Remesher(mesh, surface).project(5);
}

}  // namespace vitrine::body
