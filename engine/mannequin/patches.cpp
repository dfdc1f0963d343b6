// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_check.hpp"
#include "vitrine/mannequin.hpp"
#include "voxels.hpp"

namespace vitrine::body {

namespace {

constexpr float list_reach =
    1.75F;  ///< [voxels] from a cell's middle: its own half diagonal, and what a lookup may ask
constexpr float fold_reach = 1.15F;  ///< [voxels] from a cell's middle: folds that its corners can look across
constexpr float most_reach = 0.6F;   ///< [voxels] interpolation errs by no more, opposite walls in one cell included

/// Lists would take gigabytes for more, and folds between triangles so small are too flat to matter.
constexpr std::size_t most_facets = 400'000;

struct Pair {
  std::uint32_t brick, cell, triangle;  ///< cell: within the brick
  float distance2;                      ///< [m^2] of the triangle from the cell's middle
};

/// Every triangle with every cell whose middle it is near, by triangle.
std::vector<Pair> near_cells(const Facets& surface, const DistanceField& field, const std::array<int, 3>& bricks) {
  const float h = static_cast<float>(field.spacing), reach = list_reach * h;
  const Vec3 middle = field.origin + Vec3::Constant(0.5 * field.spacing);
  std::vector<Pair> pairs;
  pairs.reserve(std::min<std::size_t>(64 * surface.facets.size(), std::size_t{1} << 21));
  std::vector<float> line;
  for (std::size_t i = 0; i < surface.facets.size(); ++i) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::max()), high = -low;
    for (std::uint32_t v : surface.mesh.triangles[i]) {
      low = low.cwiseMin(surface.mesh.vertices[v]);
      high = high.cwiseMax(surface.mesh.vertices[v]);
    }
    int from[3], to[3];
    for (int k = 0; k < 3; ++k) {
      from[k] = std::max(0, static_cast<int>(std::ceil((low[k] - middle[k]) / field.spacing - list_reach)));
      to[k] =
          std::min(field.size[k] - 2, static_cast<int>(std::floor((high[k] - middle[k]) / field.spacing + list_reach)));
    }
    const Facet& facet = surface.facets[i];
    const int count = to[0] - from[0] + 1;
    if (count <= 0) continue;
    line.resize(static_cast<std::size_t>(count));
    for (int z = from[2]; z <= to[2]; ++z)
      for (int y = from[1]; y <= to[1]; ++y) {
        Eigen::Vector3f start = (middle + field.spacing * Vec3(from[0], y, z) - facet.origin()).cast<float>();
        const auto [first, last] = facet.within(start, h, count, reach);
        if (first >= last) continue;
        start.x() += h * static_cast<float>(first);
        facet.distances2(start, h, last - first, line.data());
        const int brick = bricks[0] * ((y >> 2) + bricks[1] * (z >> 2)), cell = (y & 3) << 2 | (z & 3) << 4;
        for (int k = 0; k < last - first; ++k)
          if (const int x = from[0] + first + k; line[k] < reach * reach)
            pairs.push_back({static_cast<std::uint32_t>(brick + (x >> 2)), static_cast<std::uint32_t>(cell | (x & 3)),
                             static_cast<std::uint32_t>(i), line[k]});
      }
  }
  return pairs;
}

/// Stable counting sort by one member.
void sort_by(std::vector<Pair>& pairs, std::uint32_t Pair::*key, std::size_t keys) {
  std::vector<std::uint32_t> place(keys + 1, 0);
  for (const Pair& p : pairs) ++place[p.*key + 1];
  for (std::size_t i = 1; i < place.size(); ++i) place[i] += place[i - 1];
  std::vector<Pair> sorted(pairs.size());
  for (const Pair& p : pairs) sorted[place[p.*key]++] = p;
  pairs = std::move(sorted);
}

void leave_out_contradictions(const DistanceField& field, SurfacePatches& patches) {
  const std::size_t sy = field.size[0], sz = sy * field.size[1];
  for (std::size_t b = 0; b < patches.brick.size(); ++b) {
    if (patches.brick[b] < 0) continue;
    const int brick = static_cast<int>(b), bx = patches.bricks[0], by = patches.bricks[1];
    for (int c = 0; c < 64; ++c) {
      const std::int32_t cell = patches.brick[b] + c;
      std::uint8_t& reach = patches.reach[static_cast<std::size_t>(cell)];
      for (int k = 0; k < 8 && reach > 0; ++k) {
        const int x = 4 * (brick % bx) + (c & 3) + (k & 1), y = 4 * (brick / bx % by) + (c >> 2 & 3) + (k >> 1 & 1),
                  z = 4 * (brick / bx / by) + (c >> 4) + (k >> 2);
        const double d = patches.distance(field.origin + field.spacing * Vec3(x, y, z), cell);
        if ((d < 0) != (field.values[static_cast<std::size_t>(x) + sy * y + sz * z] < 0)) reach = 0;
      }
    }
  }
}

}  // namespace

SurfacePatches find_patches(const Facets& surface, const DistanceField& field, bool overlaps) {
  SurfacePatches result;
  result.overlaps = overlaps;
  if (surface.facets.size() > most_facets) return result;
  const auto bricks = [&field](int k) { return (field.size[k] + 3) / 4; };
  result.bricks = {bricks(0), bricks(1), bricks(2)};
  result.brick.assign(static_cast<std::size_t>(bricks(0)) * bricks(1) * bricks(2), -1);
  std::vector<Pair> pairs = near_cells(surface, field, result.bricks);
  sort_by(pairs, &Pair::cell, 64);
  sort_by(pairs, &Pair::brick, result.brick.size());
  std::vector<Eigen::Vector3f> normals;  // side by side: the loop below asks for them all over
  normals.reserve(surface.facets.size());
  for (const Facet& facet : surface.facets) normals.push_back(facet.normal());
  const auto normal = [&](std::size_t k) -> const Eigen::Vector3f& { return normals[pairs[k].triangle]; };
  const float h = static_cast<float>(field.spacing);
  result.most = most_reach * h;
  const std::size_t sy = field.size[0], sz = sy * field.size[1];
  result.facet.reserve(pairs.size());
  for (std::size_t i = 0, end = 0; i < pairs.size(); i = end) {
    const Pair first = pairs[i];
    while (end < pairs.size() && pairs[end].brick == first.brick && pairs[end].cell == first.cell) ++end;
    const std::size_t x = 4 * (first.brick % bricks(0)) + (first.cell & 3),
                      y = 4 * (first.brick / bricks(0) % bricks(1)) + (first.cell >> 2 & 3),
                      z = 4 * (first.brick / bricks(0) / bricks(1)) + (first.cell >> 4);
    const float* v = &field.values[x + sy * y + sz * z];
    float low = v[0], high = v[0];
    for (const std::size_t k : {std::size_t{1}, sy, sy + 1, sz, sz + 1, sz + sy, sz + sy + 1}) {
      low = std::min(low, v[k]);
      high = std::max(high, v[k]);
    }
    constexpr float most = SurfacePatches::fade * most_reach;
    if (low > most * h || high < -most * h) continue;
    // Nearest to the cell first: most lookups end there.
    std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(i), pairs.begin() + static_cast<std::ptrdiff_t>(end),
              [](const Pair& a, const Pair& b) {
                return a.distance2 < b.distance2 || (a.distance2 == b.distance2 && a.triangle < b.triangle);
              });
    // Trilinear interpolation across a fold errs by a quarter of the slope's change along each axis times the spacing.
    float turn = 0;
    for (std::size_t k = i;
         k < end && pairs[k].distance2 <= fold_reach * fold_reach * h * h && 0.25F * turn < most_reach; ++k)
      for (std::size_t m = i; m < k; ++m) turn = std::max(turn, (normal(k) - normal(m)).lpNorm<1>());
    const float reach = std::min(0.25F * turn, most_reach) * h;
    if (reach < 1e-7F) continue;
    if (low > SurfacePatches::fade * reach || high < -SurfacePatches::fade * reach) continue;
    std::int32_t& start = result.brick[first.brick];
    if (start < 0) {
      start = static_cast<std::int32_t>(result.reach.size());
      result.reach.insert(result.reach.end(), 64, 0);
      result.first.insert(result.first.end(), 64, static_cast<std::uint32_t>(result.facet.size()));
    }
    const std::size_t here = static_cast<std::size_t>(start) + first.cell;
    result.reach[here] = static_cast<std::uint8_t>(std::ceil(reach / result.most * 255));
    const float farthest = 0.867F * h + (1 + SurfacePatches::fade) * reach;
    for (std::size_t k = i; k < end && pairs[k].distance2 <= farthest * farthest; ++k)
      result.facet.push_back(pairs[k].triangle);
    std::fill(result.first.begin() + static_cast<std::ptrdiff_t>(here) + 1, result.first.end(),
              static_cast<std::uint32_t>(result.facet.size()));
  }
  result.first.push_back(static_cast<std::uint32_t>(result.facet.size()));
  const float outward = signed_volume(surface.mesh) < 0 ? -1.0F : 1.0F;
  result.facets.reserve(surface.facets.size());
  for (std::size_t i = 0; i < surface.facets.size(); ++i) {
    const Triangle& t = surface.mesh.triangles[i];
    const Vec3& a = surface.mesh.vertices[t[0]];
    result.facets.push_back({a, (surface.mesh.vertices[t[1]] - a).cast<float>(),
                             (surface.mesh.vertices[t[2]] - a).cast<float>(), outward * normals[i]});
  }
  if (overlaps) leave_out_contradictions(field, result);
  return result;
}

}  // namespace vitrine::body

namespace vitrine {

SurfacePatches find_patches(const TriMesh& body, const DistanceField& field, bool overlaps) {
  return body::find_patches(body::Facets(body), field, overlaps);
}

}  // namespace vitrine
