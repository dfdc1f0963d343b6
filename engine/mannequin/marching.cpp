// SPDX-License-Identifier: GPL-3.0-or-later
#include "marching.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace vitrine::body {

namespace {

// Marching cubes with a table that is derived here, not copied: on every face the inside corners are cut off singly
// (never joined across the face), so the two cubes of a face always agree and the surface closes. Polygons are split so
// that no diagonal lies in a cube's face, where the neighbour could use the same diagonal again; with that every edge
// has exactly two triangles. Corner bits: 1 = x, 2 = y, 4 = z.
constexpr std::array<std::array<int, 4>, 6> faces{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
constexpr std::array<std::array<int, 2>, 12> edges{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

int edge_between(int a, int b) {
  for (int e = 0; e < 12; ++e)
    if ((edges[e][0] == a && edges[e][1] == b) || (edges[e][0] == b && edges[e][1] == a)) return e;
  return -1;
}

bool share_face(int e, int f) {
  for (const auto& face : faces) {
    const auto on = [&face](int corner) { return std::find(face.begin(), face.end(), corner) != face.end(); };
    if (on(edges[e][0]) && on(edges[e][1]) && on(edges[f][0]) && on(edges[f][1])) return true;
  }
  return false;
}

struct Case {
  std::vector<std::array<int, 3>> triangles;  ///< cube edges; 12 + i = centre of loop i
  std::vector<std::vector<int>> centred;      ///< loops that need a centre
};

Case make_case(int inside) {
  std::array<int, 12> next;
  next.fill(-1);
  for (const auto& face : faces) {
    // Walk the face; pair each way out of the inside with the way in that began the same run of inside corners.
    for (int i = 0; i < 4; ++i) {
      if (((inside >> face[i]) & 1) != 0 || ((inside >> face[(i + 1) % 4]) & 1) == 0) continue;
      int j = (i + 1) % 4;
      while (((inside >> face[(j + 1) % 4]) & 1) != 0) j = (j + 1) % 4;
      next[edge_between(face[j], face[(j + 1) % 4])] = edge_between(face[i], face[(i + 1) % 4]);
    }
  }
  Case result;
  std::array<bool, 12> seen{};
  for (int e = 0; e < 12; ++e) {
    if (next[e] < 0 || seen[e]) continue;
    std::vector<int> loop;
    for (int f = e; !seen[f]; f = next[f]) {
      seen[f] = true;
      loop.push_back(f);
    }
    const int n = static_cast<int>(loop.size());
    int apex = -1;
    for (int i = 0; i < n && apex < 0; ++i) {
      bool clean = true;
      for (int j = 2; j + 1 < n; ++j) clean = clean && !share_face(loop[i], loop[(i + j) % n]);
      if (clean) apex = i;
    }
    if (apex >= 0) {
      for (int j = 1; j + 1 < n; ++j)
        result.triangles.push_back({loop[apex], loop[(apex + j) % n], loop[(apex + j + 1) % n]});
    } else {
      const int centre = 12 + static_cast<int>(result.centred.size());
      result.centred.push_back(loop);
      for (int j = 0; j < n; ++j) result.triangles.push_back({centre, loop[j], loop[(j + 1) % n]});
    }
  }
  return result;
}

const std::array<Case, 256>& cases() {
  static const std::array<Case, 256> table = [] {
    std::array<Case, 256> t;
    for (int i = 0; i < 256; ++i) t[i] = make_case(i);
    return t;
  }();
  return table;
}

}  // namespace

TriMesh march(const std::function<double(const Vec3&)>& field, const Vec3& low, const Vec3& high, double spacing,
              double slack) {
  // Corners are spread evenly about the box's middle, so a box that is symmetric gives a mesh that is symmetric.
  std::array<int, 3> n{};
  Vec3 origin;
  for (int a = 0; a < 3; ++a) {
    n[a] = static_cast<int>(std::ceil((high[a] - low[a]) / spacing)) + 2;
    origin[a] = 0.5 * (low[a] + high[a]) - 0.5 * spacing * (n[a] - 1);
  }
  const std::size_t row = n[0], slab = row * n[1];
  const auto index = [&](int x, int y, int z) { return x + row * y + slab * z; };
  const auto corner = [&](int x, int y, int z) { return Vec3(origin + spacing * Vec3(x, y, z)); };
  constexpr float unknown = 1e9F;
  std::vector<float> value(slab * n[2], unknown);
  constexpr int block = 4;
  const std::array<int, 3> blocks{(n[0] + block - 1) / block, (n[1] + block - 1) / block, (n[2] + block - 1) / block};
  std::vector<std::array<int, 3>> near;
  std::vector<char> queued(static_cast<std::size_t>(blocks[0]) * blocks[1] * blocks[2], 0);
  const auto queue = [&](int x, int y, int z) {
    if (x < 0 || y < 0 || z < 0 || x >= blocks[0] || y >= blocks[1] || z >= blocks[2]) return;
    char& done = queued[x + static_cast<std::size_t>(blocks[0]) * (y + static_cast<std::size_t>(blocks[1]) * z)];
    if (done == 0) near.push_back({x * block, y * block, z * block});
    done = 1;
  };
  const double reach = 0.5 * std::sqrt(3.0) * block * spacing + slack;
  for (int z = 0; z < blocks[2]; ++z)
    for (int y = 0; y < blocks[1]; ++y)
      for (int x = 0; x < blocks[0]; ++x) {
        const Vec3 middle = corner(x * block, y * block, z * block) + Vec3::Constant(0.5 * block * spacing);
        if (std::abs(field(middle)) < reach) queue(x, y, z);
      }
  // The surface is then followed from block to block, so a field that is not quite metric leaves no hole.
  for (std::size_t next = 0; next < near.size(); ++next) {
    const std::array<int, 3> b = near[next];
    std::array<std::array<bool, 2>, 6> signs{};
    for (int k = b[2]; k <= std::min(b[2] + block, n[2] - 1); ++k)
      for (int j = b[1]; j <= std::min(b[1] + block, n[1] - 1); ++j)
        for (int i = b[0]; i <= std::min(b[0] + block, n[0] - 1); ++i) {
          float& v = value[index(i, j, k)];
          if (v == unknown) v = static_cast<float>(field(corner(i, j, k)));
          const std::array<int, 3> at{i, j, k};
          for (int a = 0; a < 3; ++a) {
            if (at[a] == b[a]) signs[2 * a][v < 0] = true;
            if (at[a] == b[a] + block) signs[2 * a + 1][v < 0] = true;
          }
        }
    for (int side = 0; side < 6; ++side)
      if (signs[side][0] && signs[side][1]) {
        std::array<int, 3> to{b[0] / block, b[1] / block, b[2] / block};
        to[side / 2] += side % 2 == 0 ? -1 : 1;
        queue(to[0], to[1], to[2]);
      }
  }
  TriMesh mesh;
  std::array<std::vector<std::int32_t>, 3> crossing;
  for (auto& axis : crossing) axis.assign(value.size(), -1);
  for (const auto& b : near)
    for (int z = b[2]; z < std::min(b[2] + block, n[2] - 1); ++z)
      for (int y = b[1]; y < std::min(b[1] + block, n[1] - 1); ++y)
        for (int x = b[0]; x < std::min(b[0] + block, n[0] - 1); ++x) {
          int inside = 0;
          for (int c = 0; c < 8; ++c)
            if (value[index(x + (c & 1), y + ((c >> 1) & 1), z + (c >> 2))] < 0) inside |= 1 << c;
          if (inside == 0 || inside == 255) continue;
          const Case& here = cases()[inside];
          std::array<std::uint32_t, 16> id{};
          std::array<bool, 16> made{};
          const auto vertex = [&](int e) {
            if (made[e]) return id[e];
            made[e] = true;
            if (e >= 12) {
              Vec3 sum = Vec3::Zero();
              const auto& loop = here.centred[e - 12];
              for (int f : loop) sum += mesh.vertices[id[f]];
              mesh.vertices.push_back(sum / static_cast<double>(loop.size()));
              return id[e] = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
            }
            const int c0 = edges[e][0], c1 = edges[e][1];
            const int i = x + (c0 & 1), j = y + ((c0 >> 1) & 1), k = z + (c0 >> 2);
            const int axis = (c0 ^ c1) == 1 ? 0 : (c0 ^ c1) == 2 ? 1 : 2;
            std::int32_t& slot = crossing[axis][index(i, j, k)];
            if (slot < 0) {
              const double v0 = value[index(i, j, k)];
              const double v1 = value[index(x + (c1 & 1), y + ((c1 >> 1) & 1), z + (c1 >> 2))];
              // Kept off the corners: a vertex on a corner would make triangles without area.
              const double t = std::clamp(v0 / (v0 - v1), 0.02, 0.98);
              Vec3 p = corner(i, j, k);
              p[axis] += t * spacing;
              slot = static_cast<std::int32_t>(mesh.vertices.size());
              mesh.vertices.push_back(p);
            }
            return id[e] = static_cast<std::uint32_t>(slot);
          };
          for (const auto& loop : here.centred)
            for (int e : loop) vertex(e);
          for (const auto& t : here.triangles) {
            const std::uint32_t a = vertex(t[0]), c = vertex(t[1]), d = vertex(t[2]);
            mesh.triangles.push_back({a, d, c});
          }
        }
  return mesh;
}

}  // namespace vitrine::body
