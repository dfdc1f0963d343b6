// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "mesh_check.hpp"
#include "vitrine/mannequin.hpp"

namespace vitrine {

namespace {

constexpr std::size_t most_voxels = std::size_t{1} << 27;  ///< 128 M: 0.5 GB of floats, 0.5 GB of triangle numbers
constexpr std::size_t most_triangles = 2'000'000;

/// Squared distance from p to the triangle a b c (Ericson, Real-Time Collision Detection, 5.1.5).
double triangle_distance2(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return ap.squaredNorm();
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return bp.squaredNorm();
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return (ap - d1 / (d1 - d3) * ab).squaredNorm();
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return cp.squaredNorm();
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return (ap - d2 / (d2 - d6) * ac).squaredNorm();
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return (bp - (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b)).squaredNorm();
  const double denominator = va + vb + vc;
  if (!(denominator > 0)) return ap.squaredNorm();
  return (ap - vb / denominator * ab - vc / denominator * ac).squaredNorm();
}

struct Grid {
  Vec3 origin;
  double spacing;
  std::array<int, 3> n;
  std::size_t index(int x, int y, int z) const {
    return x + static_cast<std::size_t>(n[0]) * (y + static_cast<std::size_t>(n[1]) * z);
  }
  Vec3 at(int x, int y, int z) const { return origin + spacing * Vec3(x, y, z); }
};

/// Exact distances in a band of about two voxels around the surface.
void fill_band(const TriMesh& body, const Grid& g, std::vector<float>& distance, std::vector<std::int32_t>& nearest) {
  const double band = 2.0 * g.spacing;
  for (std::size_t i = 0; i < body.triangles.size(); ++i) {
    const Vec3 &a = body.vertices[body.triangles[i][0]], &b = body.vertices[body.triangles[i][1]],
               &c = body.vertices[body.triangles[i][2]];
    const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    int from[3], to[3];
    for (int k = 0; k < 3; ++k) {
      from[k] = std::max(0, static_cast<int>(std::ceil((low[k] - band - g.origin[k]) / g.spacing)));
      to[k] = std::min(g.n[k] - 1, static_cast<int>(std::floor((high[k] + band - g.origin[k]) / g.spacing)));
    }
    const Vec3 normal = (b - a).cross(c - a).normalized();
    for (int z = from[2]; z <= to[2]; ++z)
      for (int y = from[1]; y <= to[1]; ++y)
        for (int x = from[0]; x <= to[0]; ++x) {
          const Vec3 p = g.at(x, y, z);
          if (std::abs((p - a).dot(normal)) > band) continue;
          const float d = static_cast<float>(std::sqrt(triangle_distance2(p, a, b, c)));
          const std::size_t v = g.index(x, y, z);
          if (d < distance[v]) {
            distance[v] = d;
            nearest[v] = static_cast<std::int32_t>(i);
          }
        }
  }
}

/// Carries the nearest triangle from voxel to voxel (vector distance sweeping): far from the surface the distance is
/// that to a true triangle, so it is never too small and very nearly exact.
void sweep(const TriMesh& body, const Grid& g, std::vector<float>& distance, std::vector<std::int32_t>& nearest) {
  const auto pull = [&](const Vec3& p, std::size_t v, std::size_t from) {
    const std::int32_t t = nearest[from];
    if (t < 0 || t == nearest[v]) return;
    // The neighbour's distance bounds what it can offer.
    if (distance[from] - 1.001 * g.spacing >= distance[v]) return;
    const Triangle& corner = body.triangles[static_cast<std::size_t>(t)];
    const float d = static_cast<float>(
        std::sqrt(triangle_distance2(p, body.vertices[corner[0]], body.vertices[corner[1]], body.vertices[corner[2]])));
    if (d < distance[v]) {
      distance[v] = d;
      nearest[v] = t;
    }
  };
  const std::size_t row = g.n[0], slab = row * g.n[1];
  for (int pass = 0; pass < 2; ++pass) {
    const bool up = pass == 0;
    for (int k = 0; k < g.n[2]; ++k) {
      const int z = up ? k : g.n[2] - 1 - k;
      for (int half = 0; half < 2; ++half)
        for (int j = 0; j < g.n[1]; ++j) {
          const int y = half == 0 ? j : g.n[1] - 1 - j;
          for (int quarter = 0; quarter < 2; ++quarter)
            for (int i = 0; i < g.n[0]; ++i) {
              const int x = quarter == 0 ? i : g.n[0] - 1 - i;
              const std::size_t v = g.index(x, y, z);
              const Vec3 p = g.at(x, y, z);
              if (quarter == 0) {
                if (half == 0 && z != (up ? 0 : g.n[2] - 1)) pull(p, v, up ? v - slab : v + slab);
                if (y != (half == 0 ? 0 : g.n[1] - 1)) pull(p, v, half == 0 ? v - row : v + row);
              }
              if (x != (quarter == 0 ? 0 : g.n[0] - 1)) pull(p, v, quarter == 0 ? v - 1 : v + 1);
            }
        }
    }
  }
}

/// Inside or outside by counting crossings along each grid line in x: on a watertight mesh the count cannot be misled,
/// provided that a line through an edge or corner meets it on one side only; the comparisons below are half-open.
void sign_by_parity(const TriMesh& body, const Grid& g, std::vector<float>& distance) {
  std::vector<std::vector<float>> crossing(static_cast<std::size_t>(g.n[1]) * g.n[2]);
  for (const Triangle& t : body.triangles) {
    const Vec3 *a = &body.vertices[t[0]], *b = &body.vertices[t[1]], *c = &body.vertices[t[2]];
    const double low_y = std::min({a->y(), b->y(), c->y()}), high_y = std::max({a->y(), b->y(), c->y()});
    const int y0 = std::max(0, static_cast<int>(std::ceil((low_y - g.origin.y()) / g.spacing)));
    const int y1 = std::min(g.n[1] - 1, static_cast<int>(std::floor((high_y - g.origin.y()) / g.spacing)));
    for (int y = y0; y <= y1; ++y) {
      const double level = g.origin.y() + g.spacing * y;
      // The triangle cut at this level: two points, each computed from its mesh edge alone (low vertex first), so the
      // neighbour over that edge gets the very same numbers.
      double cut_z[3], cut_x[3];
      int cuts = 0;
      const Vec3* corner[3] = {a, b, c};
      for (int i = 0; i < 3; ++i) {
        const Vec3 *p = corner[i], *q = corner[(i + 1) % 3];
        if ((p->y() >= level) == (q->y() >= level)) continue;
        if (q->y() < p->y()) std::swap(p, q);
        const double f = (level - p->y()) / (q->y() - p->y());
        cut_z[cuts] = p->z() + f * (q->z() - p->z());
        cut_x[cuts++] = p->x() + f * (q->x() - p->x());
      }
      if (cuts != 2 || cut_z[0] == cut_z[1]) continue;
      if (cut_z[0] > cut_z[1]) {
        std::swap(cut_z[0], cut_z[1]);
        std::swap(cut_x[0], cut_x[1]);
      }
      const int z0 = std::max(0, static_cast<int>(std::floor((cut_z[0] - g.origin.z()) / g.spacing)) - 1);
      const int z1 = std::min(g.n[2] - 1, static_cast<int>(std::ceil((cut_z[1] - g.origin.z()) / g.spacing)) + 1);
      for (int z = z0; z <= z1; ++z) {
        const double depth = g.origin.z() + g.spacing * z;
        if ((cut_z[0] >= depth) == (cut_z[1] >= depth)) continue;
        const double f = (depth - cut_z[0]) / (cut_z[1] - cut_z[0]);
        crossing[y + static_cast<std::size_t>(g.n[1]) * z].push_back(
            static_cast<float>((cut_x[0] + f * (cut_x[1] - cut_x[0]) - g.origin.x()) / g.spacing));
      }
    }
  }
  for (int z = 0; z < g.n[2]; ++z)
    for (int y = 0; y < g.n[1]; ++y) {
      std::vector<float>& line = crossing[y + static_cast<std::size_t>(g.n[1]) * z];
      std::sort(line.begin(), line.end());
      for (std::size_t i = 0; i + 1 < line.size(); i += 2) {
        const int from = std::max(0, static_cast<int>(std::ceil(line[i])));
        const int to = std::min(g.n[0] - 1, static_cast<int>(std::floor(line[i + 1])));
        for (int x = from; x <= to; ++x) distance[g.index(x, y, z)] *= -1.0F;
      }
    }
}

Error refuse(const char* code, const std::string& message, const char* remedy) {
  return Error{Cause::unusable, code, message, remedy, ""};
}

}  // namespace

Result<DistanceField> voxelise(const TriMesh& body, const VoxelOptions& options) {
  if (!(options.spacing >= 5e-4 && options.spacing <= 0.1) || !(options.margin >= 0 && options.margin <= 2))
    return Error{Cause::usage, "BAD_OPTION", "The voxel spacing or margin is out of range.",
                 "Give a spacing of 0.0005 to 0.1 m and a margin of 0 to 2 m.", ""};
  if (body.triangles.empty() || body.vertices.empty())
    return refuse("NOT_WATERTIGHT", "The body has no triangles.", "Give a closed mesh.");
  if (body.triangles.size() > most_triangles || body.vertices.size() > 3 * most_triangles)
    return refuse("TOO_LARGE", "The body has more than 2,000,000 triangles.", "Simplify the mesh.");
  const body::MeshState state = body::inspect(body);
  if (!state.valid_indices || !state.finite)
    return refuse("NOT_WATERTIGHT", "The body has triangles or vertices that are not numbers.",
                  "Export the mesh again.");
  if (!state.closed())
    return refuse("NOT_WATERTIGHT",
                  "The body is not closed: " + std::to_string(state.open_edges) + " open, " +
                      std::to_string(state.crowded_edges) + " crowded, " + std::to_string(state.turned_edges) +
                      " wrongly turned edges.",
                  "Close the holes and unify the normals in a mesh editor.");
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max()), high = -low;
  for (const Triangle& t : body.triangles)
    for (std::uint32_t v : t) {
      low = low.cwiseMin(body.vertices[v]);
      high = high.cwiseMax(body.vertices[v]);
    }
  Grid g{low - Vec3::Constant(options.margin), options.spacing, {0, 0, 0}};
  double voxels = 1;
  for (int a = 0; a < 3; ++a) {
    const double count = std::ceil((high[a] - low[a] + 2 * options.margin) / options.spacing) + 1;
    voxels *= count;
    if (!(voxels <= static_cast<double>(most_voxels)))
      return refuse("TOO_LARGE", "The voxels around the body would not fit in memory.",
                    "Check the mesh's unit (metres) or choose a larger voxel spacing.");
    g.n[a] = std::max(2, static_cast<int>(count));
  }
  DistanceField field;
  field.origin = g.origin;
  field.spacing = g.spacing;
  field.size = g.n;
  const std::size_t total = static_cast<std::size_t>(g.n[0]) * g.n[1] * g.n[2];
  field.values.assign(total, std::numeric_limits<float>::max());
  std::vector<std::int32_t> nearest(total, -1);
  fill_band(body, g, field.values, nearest);
  sweep(body, g, field.values, nearest);
  sign_by_parity(body, g, field.values);
  return field;
}

}  // namespace vitrine
