// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>

#include "mesh_check.hpp"
#include "vitrine/mannequin.hpp"
#include "voxels.hpp"

namespace vitrine {

using body::Facet;
using body::Grid;
using body::Facets;

namespace {

constexpr std::size_t most_voxels = std::size_t{1} << 27;  ///< 128 M: 0.5 GB of floats
constexpr std::size_t most_body_triangles = 2'000'000;

/// Exact distances up to `band` [m] from the surface and, where `nearest` is not empty, the triangles they lead to.
void fill_band(const Facets& surface, const Grid& g, double band, std::vector<float>& distance,
               std::span<std::int32_t> nearest) {
  const TriMesh& body = surface.mesh;
  constexpr float far = std::numeric_limits<float>::max();
  const float band2 = static_cast<float>(band * band), step = static_cast<float>(g.spacing);
  std::vector<float> row;
  for (std::size_t i = 0; i < body.triangles.size(); ++i) {
    const Vec3 &a = body.vertices[body.triangles[i][0]], &b = body.vertices[body.triangles[i][1]],
               &c = body.vertices[body.triangles[i][2]];
    const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    int from[3], to[3];
    for (int k = 0; k < 3; ++k) {
      from[k] = std::max(0, static_cast<int>(std::ceil((low[k] - band - g.origin[k]) / g.spacing)));
      to[k] = std::min(g.n[k] - 1, static_cast<int>(std::floor((high[k] + band - g.origin[k]) / g.spacing)));
    }
    const Facet& facet = surface.facets[i];
    const int count = to[0] - from[0] + 1;
    if (count <= 0) continue;
    row.resize(static_cast<std::size_t>(count));
    for (int z = from[2]; z <= to[2]; ++z)
      for (int y = from[1]; y <= to[1]; ++y) {
        Eigen::Vector3f start = (g.at(from[0], y, z) - facet.origin()).cast<float>();
        const auto [first, last] = facet.within(start, step, count, static_cast<float>(band));
        if (first >= last) continue;
        start.x() += step * static_cast<float>(first);
        facet.distances2(start, step, last - first, row.data());
        const std::size_t at = g.index(from[0] + first, y, z);
        for (int k = 0; k < last - first; ++k) row[k] = row[k] < band2 ? std::sqrt(row[k]) : far;
        float* known = &distance[at];
        if (!nearest.empty())
          for (int k = 0; k < last - first; ++k)
            if (row[k] < known[k]) nearest[at + static_cast<std::size_t>(k)] = static_cast<std::int32_t>(i);
        for (int k = 0; k < last - first; ++k) known[k] = row[k] < known[k] ? row[k] : known[k];
      }
  }
}

/// Carries the nearest triangle from voxel to voxel (vector distance sweeping): far from the surface the distance is
/// that to a true triangle, so it is never too small and very nearly exact.
void sweep(const Facets& body, const Grid& g, std::vector<float>& distance, std::vector<std::int32_t>& nearest) {
  const auto pull = [&](const Vec3& p, std::size_t v, std::size_t from) {
    const std::int32_t t = nearest[from];
    if (t < 0 || t == nearest[v]) return;
    // The neighbour's distance bounds what it can offer.
    if (distance[from] - 1.001 * g.spacing >= distance[v]) return;
    const float d = static_cast<float>(std::sqrt(body.distance2(p, t)));
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

/// Where a grid line along x meets the surface.
struct Crossing {
  float x;  ///< [voxels]
  int way;  ///< 1 into the body, -1 out of it
  bool operator<(const Crossing& other) const { return x < other.x; }
};

/// Inside or outside by the winding number along each grid line in x: on a watertight mesh the count cannot be misled,
/// provided that a line through an edge or corner meets it on one side only; the comparisons below are half-open. Where
/// the mesh overlaps itself (a hand in a thigh) it is inside twice,
/// which is inside; gives whether that was seen.
bool sign_by_winding(const TriMesh& body, const Grid& g, std::vector<float>& distance) {
  std::vector<std::vector<Crossing>> crossing(static_cast<std::size_t>(g.n[1]) * g.n[2]);
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
      int cuts = 0, rising = 0;  // rising: which cut the triangle's outline passes upwards
      const Vec3* corner[3] = {a, b, c};
      for (int i = 0; i < 3; ++i) {
        const Vec3 *p = corner[i], *q = corner[(i + 1) % 3];
        if ((p->y() >= level) == (q->y() >= level)) continue;
        if (q->y() < p->y())
          std::swap(p, q);
        else
          rising = cuts;
        const double f = (level - p->y()) / (q->y() - p->y());
        cut_z[cuts] = p->z() + f * (q->z() - p->z());
        cut_x[cuts++] = p->x() + f * (q->x() - p->x());
      }
      if (cuts != 2 || cut_z[0] == cut_z[1]) continue;
      if (cut_z[0] > cut_z[1]) {
        std::swap(cut_z[0], cut_z[1]);
        std::swap(cut_x[0], cut_x[1]);
        rising = 1 - rising;
      }
      const int way = rising == 1 ? 1 : -1;  // upwards on its +z side: the triangle looks towards -x
      const int z0 = std::max(0, static_cast<int>(std::floor((cut_z[0] - g.origin.z()) / g.spacing)) - 1);
      const int z1 = std::min(g.n[2] - 1, static_cast<int>(std::ceil((cut_z[1] - g.origin.z()) / g.spacing)) + 1);
      for (int z = z0; z <= z1; ++z) {
        const double depth = g.origin.z() + g.spacing * z;
        if ((cut_z[0] >= depth) == (cut_z[1] >= depth)) continue;
        const double f = (depth - cut_z[0]) / (cut_z[1] - cut_z[0]);
        crossing[y + static_cast<std::size_t>(g.n[1]) * z].push_back(
            {static_cast<float>((cut_x[0] + f * (cut_x[1] - cut_x[0]) - g.origin.x()) / g.spacing), way});
      }
    }
  }
  bool overlaps = false;
  for (int z = 0; z < g.n[2]; ++z)
    for (int y = 0; y < g.n[1]; ++y) {
      std::vector<Crossing>& line = crossing[y + static_cast<std::size_t>(g.n[1]) * z];
      std::stable_sort(line.begin(), line.end());
      int winding = 0;
      float in = 0;
      for (const Crossing& c : line) {
        if (winding == 0) in = c.x;
        winding += c.way;
        overlaps = overlaps || std::abs(winding) > 1;
        if (winding != 0) continue;
        const int from = std::max(0, static_cast<int>(std::ceil(in)));
        const int to = std::min(g.n[0] - 1, static_cast<int>(std::floor(c.x)));
        for (int x = from; x <= to; ++x) distance[g.index(x, y, z)] = -std::abs(distance[g.index(x, y, z)]);
      }
    }
  return overlaps;
}

constexpr double band_voxels = 3;  ///< exact distances up to this many voxels from the surface: cloth lies within
constexpr int coarse_step = 4;     ///< voxels from one coarse sample to the next

/// Every fourth voxel in each direction, with the nearest triangle: beyond the band cloth only asks how far it is.
struct Coarse {
  Grid grid;
  std::vector<float> distance;  ///< [m] signed
  std::vector<std::int32_t> nearest;
  std::vector<Eigen::Vector3f> foot;  ///< nearest point, relative to the grid's origin so that floats suffice
};

/// The triangles around each vertex.
class Fans {
 public:
  explicit Fans(const TriMesh& body) : start_(body.vertices.size() + 1, 0), triangle_(3 * body.triangles.size()) {
    for (const Triangle& t : body.triangles)
      for (std::uint32_t v : t) ++start_[v + 1];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < body.triangles.size(); ++i)
      for (std::uint32_t v : body.triangles[i]) triangle_[next[v]++] = static_cast<std::int32_t>(i);
  }
  std::span<const std::int32_t> of(std::uint32_t v) const {
    return {triangle_.data() + start_[v], triangle_.data() + start_[v + 1]};
  }

 private:
  std::vector<std::uint32_t> start_;
  std::vector<std::int32_t> triangle_;
};

/// Walks over the mesh from triangle t to the one nearest to p, vertex by vertex downhill.
std::int32_t walk(const Facets& surface, const Fans& fans, const Vec3& p, std::int32_t t) {
  const TriMesh& body = surface.mesh;
  const auto off = [&](std::uint32_t v) { return (body.vertices[v] - p).squaredNorm(); };
  const Triangle& first = body.triangles[static_cast<std::size_t>(t)];
  std::uint32_t here =
      *std::min_element(first.begin(), first.end(), [&](std::uint32_t a, std::uint32_t b) { return off(a) < off(b); });
  for (std::uint32_t from = here;; from = here) {
    for (std::int32_t i : fans.of(from))
      for (std::uint32_t v : body.triangles[static_cast<std::size_t>(i)])
        if (off(v) < off(here)) here = v;
    if (here == from) break;
  }
  double least = surface.distance2(p, t);
  for (std::int32_t i : fans.of(here))
    if (const double d = surface.distance2(p, i); d < least) {
      least = d;
      t = i;
    }
  return t;
}

Coarse make_coarse(const Facets& surface, const Grid& g) {
  const TriMesh& body = surface.mesh;
  Coarse c{{g.origin, coarse_step * g.spacing, {0, 0, 0}}, {}, {}, {}};
  for (int a = 0; a < 3; ++a) c.grid.n[a] = (g.n[a] - 1) / coarse_step + 2;
  const std::size_t total = static_cast<std::size_t>(c.grid.n[0]) * c.grid.n[1] * c.grid.n[2];
  c.distance.assign(total, std::numeric_limits<float>::max());
  c.nearest.assign(total, -1);
  fill_band(surface, c.grid, c.grid.spacing, c.distance, c.nearest);
  sweep(surface, c.grid, c.distance, c.nearest);
  // A neighbour's triangle is a fair guess on so coarse a grid, no more.
  const Fans fans(body);
  c.foot.resize(total);
  for (int z = 0; z < c.grid.n[2]; ++z)
    for (int y = 0; y < c.grid.n[1]; ++y)
      for (int x = 0; x < c.grid.n[0]; ++x) {
        const std::size_t v = c.grid.index(x, y, z);
        const Vec3 p = c.grid.at(x, y, z);
        c.nearest[v] = walk(surface, fans, p, c.nearest[v]);
        const Triangle& t = body.triangles[static_cast<std::size_t>(c.nearest[v])];
        const Vec3 at = nearest_point(p, body.vertices[t[0]], body.vertices[t[1]], body.vertices[t[2]]);
        c.foot[v] = (at - g.origin).cast<float>();
        c.distance[v] = static_cast<float>((at - p).norm());
      }
  sign_by_winding(body, c.grid, c.distance);
  return c;
}

/// The eight corners of a coarse cell.
std::array<std::size_t, 8> corners(const Coarse& c, int x, int y, int z) {
  std::array<std::size_t, 8> corner;
  for (int k = 0; k < 8; ++k) corner[k] = c.grid.index(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2));
  return corner;
}

/// Beyond the band a voxel's distance is interpolated between the corners of its coarse cell or, where these look at
/// different parts of the body, taken to the nearest of their nearest points.
void fill_far(const Coarse& c, const Grid& g, float band, std::vector<float>& distance) {
  const float h = static_cast<float>(g.spacing);
  using Row = Eigen::Array<float, coarse_step, 1>;
  const Row steps = Row::LinSpaced(coarse_step, 0, coarse_step - 1);
  for (int cz = 0; cz + 1 < c.grid.n[2]; ++cz)
    for (int cy = 0; cy + 1 < c.grid.n[1]; ++cy)
      for (int cx = 0; cx + 1 < c.grid.n[0]; ++cx) {
        const std::array<std::size_t, 8> corner = corners(c, cx, cy, cz);
        // Feet further apart than the corners are lie on different parts of the body: the distance has a ridge here.
        float apart = 0;
        for (const std::size_t v : corner) apart = std::max(apart, (c.foot[v] - c.foot[corner[0]]).squaredNorm());
        const bool smooth = apart <= 3.3F * coarse_step * coarse_step * h * h;
        // Near the surface the distance bends most, and depths beyond a ridge inside would count as distances outside:
        // the way to the nearest foot is never too short there.
        const bool close = std::any_of(corner.begin(), corner.end(),
                                       [&](std::size_t v) { return c.distance[v] < 1.5F * coarse_step * h; });
        const int x0 = cx * coarse_step, x1 = std::min(x0 + coarse_step, g.n[0]);
        for (int z = cz * coarse_step; z < std::min((cz + 1) * coarse_step, g.n[2]); ++z)
          for (int y = cy * coarse_step; y < std::min((cy + 1) * coarse_step, g.n[1]); ++y) {
            float* row = &distance[g.index(x0, y, z)];
            if (*std::max_element(row, row + (x1 - x0)) <= band) continue;
            Row value = Row::Constant(std::numeric_limits<float>::max());
            if (smooth) {
              const float v = static_cast<float>(y - cy * coarse_step) / coarse_step;
              const float w = static_cast<float>(z - cz * coarse_step) / coarse_step;
              const auto edge = [&](int k) {
                return (1 - w) * ((1 - v) * c.distance[corner[k]] + v * c.distance[corner[k + 2]]) +
                       w * ((1 - v) * c.distance[corner[k + 4]] + v * c.distance[corner[k + 6]]);
              };
              value = (edge(0) + (edge(1) - edge(0)) / coarse_step * steps).abs();
            }
            if (!smooth || close) {
              const Row px = h * (static_cast<float>(x0) + steps);
              const float py = h * static_cast<float>(y), pz = h * static_cast<float>(z);
              Row least = Row::Constant(std::numeric_limits<float>::max());
              for (const std::size_t k : corner) {
                const Eigen::Vector3f& q = c.foot[k];
                const float aside = (py - q.y()) * (py - q.y()) + (pz - q.z()) * (pz - q.z());
                least = least.min((px - q.x()).square() + aside);
              }
              value = value.min(least.sqrt());
            }
            for (int x = x0; x < x1; ++x)
              if (row[x - x0] > band) row[x - x0] = std::max(band, value[x - x0]);
          }
      }
}

/// No distance may differ from its neighbour's by more than the way to it: takes out most of what was too large.
void limit_slope(const Grid& g, std::vector<float>& distance) {
  const std::size_t row = g.n[0], slab = row * g.n[1];
  const float h = static_cast<float>(g.spacing);
  const auto follow = [&](float* line, const float* other) {
    for (int x = 0; x < g.n[0]; ++x) line[x] = std::min(line[x], other[x] + h);
  };
  for (int z = 0; z < g.n[2]; ++z)
    for (int y = 0; y < g.n[1]; ++y) {
      float* line = &distance[g.index(0, y, z)];
      if (y > 0) follow(line, line - row);
      if (z > 0) follow(line, line - slab);
      for (int x = 1; x < g.n[0]; ++x) line[x] = std::min(line[x], line[x - 1] + h);
    }
  for (int z = g.n[2] - 1; z >= 0; --z)
    for (int y = g.n[1] - 1; y >= 0; --y) {
      float* line = &distance[g.index(0, y, z)];
      if (y + 1 < g.n[1]) follow(line, line + row);
      if (z + 1 < g.n[2]) follow(line, line + slab);
      for (int x = g.n[0] - 2; x >= 0; --x) line[x] = std::min(line[x], line[x + 1] + h);
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
  if (body.triangles.size() > most_body_triangles || body.vertices.size() > 3 * most_body_triangles)
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
  const Facets surface(body);
  const double band = band_voxels * g.spacing;
  fill_band(surface, g, band, field.values, {});
  fill_far(make_coarse(surface, g), g, static_cast<float>(band), field.values);
  limit_slope(g, field.values);
  const bool overlaps = sign_by_winding(body, g, field.values);
  field.patches = body::find_patches(surface, field, overlaps);
  return field;
}

}  // namespace vitrine
