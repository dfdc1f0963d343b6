// SPDX-License-Identifier: GPL-3.0-or-later
#include "prolong.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vitrine::sewing {
namespace {

constexpr double beyond = 0.5;  // [-] barycentric coordinates may leave [0, 1] so far: then extension exaggerates

/// Uniform bins over the coarse triangles.
class Bins {
 public:
  explicit Bins(const PanelMesh& mesh) : mesh_(mesh) {
    lo_ = mesh.nodes.front();
    Vec2 hi = lo_;
    for (const Vec2& p : mesh.nodes) lo_ = lo_.cwiseMin(p), hi = hi.cwiseMax(p);
    const double extent = std::max((hi - lo_).maxCoeff(), 1e-9);
    const int want = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(mesh.triangles.size()))), 1, 400);
    cell_ = extent / want;
    for (int a = 0; a < 2; ++a) size_[a] = std::min(want, static_cast<int>((hi[a] - lo_[a]) / cell_)) + 1;
    bins_.resize(static_cast<std::size_t>(size_[0]) * size_[1]);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      Vec2 from = mesh.nodes[mesh.triangles[t][0]], to = from;
      for (const auto n : mesh.triangles[t]) from = from.cwiseMin(mesh.nodes[n]), to = to.cwiseMax(mesh.nodes[n]);
      for (int y = index(from, 1); y <= index(to, 1); ++y)
        for (int x = index(from, 0); x <= index(to, 0); ++x) bins_[y * size_[0] + x].push_back(static_cast<int>(t));
    }
  }

  /// The triangle that holds p, or the one p is least outside of, and p's coordinates in it.
  int locate(const Vec2& p, Vec3& bary) const {
    const int cx = index(p, 0), cy = index(p, 1);
    int best = -1;
    double best_outside = std::numeric_limits<double>::infinity();
    for (int ring = 0; ring <= std::max(size_[0], size_[1]); ++ring) {
      for (int y = std::max(0, cy - ring); y <= std::min(size_[1] - 1, cy + ring); ++y)
        for (int x = std::max(0, cx - ring); x <= std::min(size_[0] - 1, cx + ring); ++x) {
          if (std::max(std::abs(x - cx), std::abs(y - cy)) != ring) continue;
          for (int t : bins_[y * size_[0] + x]) {
            Vec3 b = Vec3::Zero();
            const double outside = distance_outside(t, p, b);
            if (outside < best_outside) best_outside = outside, best = t, bary = b;
          }
        }
      if (best_outside <= std::max(0, ring - 1) * cell_) break;
    }
    return best;
  }

 private:
  int index(const Vec2& p, int a) const {
    return std::clamp(static_cast<int>(std::floor((p[a] - lo_[a]) / cell_)), 0, size_[a] - 1);
  }

  double distance_outside(int t, const Vec2& p, Vec3& bary) const {
    const Triangle& tri = mesh_.triangles[t];
    const Vec2 a = mesh_.nodes[tri[0]], u = mesh_.nodes[tri[1]] - a, w = mesh_.nodes[tri[2]] - a, d = p - a;
    const double det = u.x() * w.y() - u.y() * w.x();
    if (std::abs(det) < 1e-14) return std::numeric_limits<double>::infinity();
    const double s = (d.x() * w.y() - d.y() * w.x()) / det, r = (u.x() * d.y() - u.y() * d.x()) / det;
    bary = Vec3(1 - s - r, s, r);
    if (bary.minCoeff() >= -1e-9) return 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (int e = 0; e < 3; ++e) {
      const Vec2 q = mesh_.nodes[tri[e]], edge = mesh_.nodes[tri[(e + 1) % 3]] - q;
      const double along = std::clamp((p - q).dot(edge) / std::max(edge.squaredNorm(), 1e-18), 0.0, 1.0);
      nearest = std::min(nearest, (p - q - along * edge).norm());
    }
    return nearest;
  }

  const PanelMesh& mesh_;
  Vec2 lo_;
  double cell_ = 1;
  int size_[2] = {1, 1};
  std::vector<std::vector<int>> bins_;
};

}  // namespace

std::vector<Vec3> prolong(const PanelMesh& coarse, const std::vector<Vec3>& positions, const PanelMesh& fine) {
  const Bins bins(coarse);
  std::vector<Vec3> out;
  out.reserve(fine.nodes.size());
  for (const Vec2& p : fine.nodes) {
    Vec3 b(1, 0, 0);
    const int t = bins.locate(p, b);
    if (t < 0) {  // a coarse panel of degenerate triangles only
      out.push_back(positions.front());
      continue;
    }
    b = b.cwiseMax(-beyond).cwiseMin(1 + beyond);
    b /= b.sum();
    const Triangle& tri = coarse.triangles[t];
    out.push_back(b[0] * positions[tri[0]] + b[1] * positions[tri[1]] + b[2] * positions[tri[2]]);
  }
  return out;
}

}  // namespace vitrine::sewing
