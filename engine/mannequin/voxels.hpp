// SPDX-License-Identifier: GPL-3.0-or-later
// What the voxels are filled from: the body's triangles, prepared, and the grid they are asked on.
#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "vitrine/model/body.hpp"

namespace vitrine::body {

/// A triangle prepared for many questions, in floats about its own first corner: there 1e-7 is less than a nanometre.
class Facet {
 public:
  Facet(const Vec3& a, const Vec3& b, const Vec3& c) : a_(a) {
    const Vec3 corner[3] = {Vec3::Zero(), b - a, c - a};
    const Vec3 normal = corner[1].cross(corner[2]).normalized();
    for (int i = 0; i < 3; ++i) {
      const Vec3 along = corner[(i + 1) % 3] - corner[i], out = along.cross(normal);
      const double length2 = along.squaredNorm();
      side_[i] = {corner[i].cast<float>(), along.cast<float>(), out.cast<float>(),
                  length2 > 0 ? static_cast<float>(1 / length2) : 0.0F};
    }
    const Vec3 middle = (corner[1] + corner[2]) / 3;
    for (const Vec3& at : corner) radius_ = std::max(radius_, static_cast<float>((at - middle).norm()));
    middle_ = middle.cast<float>();
    normal_ = normal.cast<float>();
    // A triangle without area has only its edges.
    if (!(normal.squaredNorm() > 0.5)) beyond_ = 1;
  }

  const Vec3& origin() const { return a_; }
  const Eigen::Vector3f& normal() const { return normal_; }  ///< outward; zero where the triangle has no area

  /// Squared distances [m^2] of `count` points that begin at p, relative to origin(), and lie `step` apart along x. No
  /// branches, so that the compiler works on several points at a time.
  void distances2(const Eigen::Vector3f& p, float step, int count, float* out) const {
    for (int k = 0; k < count; ++k) {
      const float x = p.x() + step * static_cast<float>(k), y = p.y(), z = p.z();
      const float h = normal_.x() * x + normal_.y() * y + normal_.z() * z;
      float edges = std::numeric_limits<float>::max(), beyond = beyond_;
      for (const Side& s : side_) {
        const float u = x - s.corner.x(), v = y - s.corner.y(), w = z - s.corner.z();
        float t = (u * s.along.x() + v * s.along.y() + w * s.along.z()) * s.per_length2;
        t = t < 0.0F ? 0.0F : t;
        t = t > 1.0F ? 1.0F : t;
        const float du = u - t * s.along.x(), dv = v - t * s.along.y(), dw = w - t * s.along.z();
        const float d = du * du + dv * dv + dw * dw, o = u * s.out.x() + v * s.out.y() + w * s.out.z();
        edges = d < edges ? d : edges;
        beyond = o > beyond ? o : beyond;
      }
      // Above the triangle itself, the way to its plane counts.
      out[k] = beyond > 0.0F ? edges : h * h;
    }
  }

  /// Of `count` points that begin at p, `step` apart along x: from which and before which one they can be closer than
  /// `band` to the triangle, by its plane and by the ball around it.
  std::array<int, 2> within(const Eigen::Vector3f& p, float step, int count, float band) const {
    const Eigen::Vector3f d = p - middle_;
    const float ball = (radius_ + band) * (radius_ + band) - d.y() * d.y() - d.z() * d.z();
    if (ball <= 0) return {0, 0};
    const float half = std::sqrt(ball);
    float low = -d.x() - half, high = -d.x() + half;
    const float height = normal_.dot(p), slope = normal_.x();
    if (std::abs(slope) > 1e-3F) {
      const float at = -height / slope, reach = band / std::abs(slope);
      low = std::max(low, at - reach);
      high = std::min(high, at + reach);
    } else if (std::abs(height) > 2 * band) {
      return {0, 0};
    }
    const float last = static_cast<float>(count);
    return {static_cast<int>(std::clamp(std::ceil(low / step), 0.0F, last)),
            static_cast<int>(std::clamp(std::floor(high / step) + 1, 0.0F, last))};
  }

  double distance2(const Vec3& p) const {
    float d = 0;
    distances2((p - a_).cast<float>(), 0, 1, &d);
    return d;
  }

 private:
  struct Side {
    Eigen::Vector3f corner, along, out;  ///< out: in the plane, away from the triangle
    float per_length2 = 0;
  };
  Vec3 a_;
  Eigen::Vector3f normal_, middle_;
  float radius_ = 0, beyond_ = -1;
  Side side_[3];
};

/// The body's mesh and its triangles once more, prepared.
struct Facets {
  explicit Facets(const TriMesh& m) : mesh(m) {
    facets.reserve(m.triangles.size());
    for (const Triangle& t : m.triangles) facets.emplace_back(m.vertices[t[0]], m.vertices[t[1]], m.vertices[t[2]]);
  }
  double distance2(const Vec3& p, std::int32_t t) const { return facets[static_cast<std::size_t>(t)].distance2(p); }
  const TriMesh& mesh;
  std::vector<Facet> facets;
};

struct Grid {
  Vec3 origin;
  double spacing;
  std::array<int, 3> n;
  std::size_t index(int x, int y, int z) const {
    return x + static_cast<std::size_t>(n[0]) * (y + static_cast<std::size_t>(n[1]) * z);
  }
  Vec3 at(int x, int y, int z) const { return origin + spacing * Vec3(x, y, z); }
};

/// The triangles that decide the sign in each cell that the surface passes, for a field whose values are known. Where
/// the mesh overlaps itself, triangles lie inside the body; cells whose triangles contradict the values are left out.
SurfacePatches find_patches(const Facets& surface, const DistanceField& field, bool overlaps);

}  // namespace vitrine::body
