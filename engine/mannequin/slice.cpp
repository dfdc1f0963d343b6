// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "hull.hpp"

namespace vitrine::body {

namespace {

struct End {
  std::uint64_t edge;  ///< mesh edge the segment ends on
  std::uint32_t segment;
};

void finish(Ring& ring, const Vec3& normal) {
  ring.u = normal.cross(std::abs(normal.y()) < 0.9 ? Vec3::UnitY().eval() : Vec3::UnitX().eval()).normalized();
  ring.v = normal.cross(ring.u);
  std::vector<Vec2> flat;
  flat.reserve(ring.points.size());
  ring.low = ring.high = ring.points.front();
  const Vec3 start = ring.points.front();
  for (const Vec3& p : ring.points) {
    flat.emplace_back((p - start).dot(ring.u), (p - start).dot(ring.v));
    ring.low = ring.low.cwiseMin(p);
    ring.high = ring.high.cwiseMax(p);
  }
  double twice = 0;
  Vec2 moment = Vec2::Zero();
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const Vec2 &a = flat[i], &b = flat[(i + 1) % flat.size()];
    const double cross = a.x() * b.y() - a.y() * b.x();
    twice += cross;
    moment += cross * (a + b);
  }
  const Vec2 centre = std::abs(twice) > 1e-14 ? Vec2(moment / (3 * twice)) : flat.front();
  ring.centre = start + centre.x() * ring.u + centre.y() * ring.v;
  ring.area = 0.5 * std::abs(twice);
  ring.tape = hull_perimeter(flat);
}

}  // namespace

bool Ring::holds(const Vec3& p) const {
  bool inside = false;
  const double x = p.dot(u), y = p.dot(v);
  for (std::size_t i = 0, j = points.size() - 1; i < points.size(); j = i++) {
    const double xi = points[i].dot(u), yi = points[i].dot(v), xj = points[j].dot(u), yj = points[j].dot(v);
    if ((yi > y) != (yj > y) && x < xi + (xj - xi) * (y - yi) / (yj - yi)) inside = !inside;
  }
  return inside;
}

std::vector<Ring> slice(const TriMesh& mesh, const Vec3& point, const Vec3& normal) {
  return slice(mesh, point, normal, {});
}

std::vector<Ring> slice(const TriMesh& mesh, const Vec3& point, const Vec3& normal, const std::vector<char>& keep) {
  std::vector<double> side(mesh.vertices.size());
  for (std::size_t i = 0; i < side.size(); ++i) side[i] = (mesh.vertices[i] - point).dot(normal);
  std::vector<End> ends;
  std::vector<Vec3> at;  // two points a segment, in the order of `ends`
  for (const Triangle& t : mesh.triangles) {
    // A vertex on the plane counts as above, so that every triangle is crossed on two edges or not at all.
    const bool above[3] = {side[t[0]] >= 0, side[t[1]] >= 0, side[t[2]] >= 0};
    if (above[0] == above[1] && above[1] == above[2]) continue;
    if (!keep.empty() && !keep[t[0]] && !keep[t[1]] && !keep[t[2]]) continue;
    const std::uint32_t segment = static_cast<std::uint32_t>(ends.size() / 2);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      if (above[i] == above[j]) continue;
      const std::uint64_t a = std::min(t[i], t[j]), b = std::max(t[i], t[j]);
      const double f = side[a] / (side[a] - side[b]);
      ends.push_back({a << 32 | b, segment});
      at.push_back(mesh.vertices[a] + f * (mesh.vertices[b] - mesh.vertices[a]));
    }
  }
  std::vector<std::uint32_t> order(ends.size()), partner(ends.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = partner[i] = i;
  std::sort(order.begin(), order.end(), [&ends](std::uint32_t a, std::uint32_t b) {
    return ends[a].edge < ends[b].edge || (ends[a].edge == ends[b].edge && a < b);
  });
  for (std::size_t i = 0; i + 1 < order.size(); ++i)
    if (ends[order[i]].edge == ends[order[i + 1]].edge) {
      partner[order[i]] = order[i + 1];
      partner[order[i + 1]] = order[i];
      ++i;
    }
  std::vector<Ring> rings;
  std::vector<char> seen(ends.size(), 0);
  for (std::uint32_t first = 0; first < ends.size(); ++first) {
    if (seen[first]) continue;
    Ring ring;
    std::uint32_t at_end = first;
    bool closed = false;
    while (!seen[at_end]) {
      seen[at_end] = 1;
      ring.points.push_back(at[at_end]);
      const std::uint32_t other = at_end ^ 1U;
      seen[other] = 1;
      if (partner[other] == other) break;
      at_end = partner[other];
      closed = at_end == first;
    }
    if (!closed || ring.points.size() < 3) continue;
    finish(ring, normal);
    rings.push_back(std::move(ring));
  }
  std::stable_sort(rings.begin(), rings.end(), [](const Ring& a, const Ring& b) { return a.area > b.area; });
  return rings;
}

}  // namespace vitrine::body
