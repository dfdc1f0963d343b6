// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "vitrine/accuracy.hpp"

namespace vitrine {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge(std::uint32_t a, std::uint32_t b) {
  return std::minmax(a, b);
}

/// Chains of neighbours, each of which has at most two; `closed` tells whether its ends meet.
struct Chain {
  std::vector<std::size_t> members;
  bool closed = false;
};
std::vector<Chain> chains_of(const std::vector<std::vector<std::size_t>>& neighbours) {
  std::vector<Chain> chains;
  std::vector<char> seen(neighbours.size(), 0);
  const auto follow = [&](std::size_t start) {
    Chain chain;
    for (std::size_t at = start, more = 1; more;) {
      seen[at] = 1;
      chain.members.push_back(at);
      more = 0;
      for (const std::size_t n : neighbours[at])
        if (!seen[n]) {
          at = n, more = 1;
          break;
        }
    }
    const auto& last = neighbours[chain.members.back()];
    chain.closed = chain.members.size() > 2 && std::find(last.begin(), last.end(), start) != last.end();
    chains.push_back(std::move(chain));
  };
  // Open ends first, or a chain would be begun in its middle.
  for (std::size_t i = 0; i < neighbours.size(); ++i)
    if (!seen[i] && neighbours[i].size() == 1) follow(i);
  for (std::size_t i = 0; i < neighbours.size(); ++i)
    if (!seen[i] && !neighbours[i].empty()) follow(i);
  return chains;
}

double tape(const std::vector<cv::Point2f>& ring) {
  std::vector<cv::Point2f> hull;
  cv::convexHull(ring, hull);
  return cv::arcLength(hull, true);
}

}  // namespace

std::optional<double> girth_at(const TriMesh& garment, double height, const Vec2& x_z) {
  std::map<Edge, std::size_t> number;  // of the place where the plane meets an edge
  std::vector<cv::Point2f> places;
  std::vector<std::vector<std::size_t>> neighbours;
  const auto place = [&](std::uint32_t a, std::uint32_t b) {
    const auto [found, is_new] = number.try_emplace(edge(a, b), places.size());
    if (is_new) {
      const Vec3 &p = garment.vertices[found->first.first], &q = garment.vertices[found->first.second];
      const Vec3 cut = p + (height - p.y()) / (q.y() - p.y()) * (q - p);
      places.emplace_back(static_cast<float>(cut.x() - x_z.x()), static_cast<float>(cut.z() - x_z.y()));
      neighbours.emplace_back();
    }
    return found->second;
  };
  for (const Triangle& t : garment.triangles) {
    std::vector<std::size_t> ends;
    for (int e = 0; e < 3; ++e) {
      const std::uint32_t a = t[e], b = t[(e + 1) % 3];
      // A vertex in the plane counts as above it, so that no edge lies in it.
      if ((garment.vertices[a].y() < height) != (garment.vertices[b].y() < height)) ends.push_back(place(a, b));
    }
    if (ends.size() != 2) continue;
    neighbours[ends[0]].push_back(ends[1]);
    neighbours[ends[1]].push_back(ends[0]);
  }
  std::optional<double> girth;
  for (const Chain& chain : chains_of(neighbours)) {
    if (!chain.closed) continue;
    std::vector<cv::Point2f> ring;
    for (const std::size_t i : chain.members) ring.push_back(places[i]);
    if (cv::pointPolygonTest(ring, {0, 0}, false) <= 0) continue;
    girth = std::max(girth.value_or(0), tape(ring));
  }
  return girth;
}

std::optional<double> hem_height(const TriMesh& garment) {
  std::map<Edge, int> triangles_at;
  for (const Triangle& t : garment.triangles)
    for (int e = 0; e < 3; ++e) ++triangles_at[edge(t[e], t[(e + 1) % 3])];
  std::vector<std::vector<std::size_t>> neighbours(garment.vertices.size());
  for (const auto& [ends, count] : triangles_at)
    if (count == 1) {
      neighbours[ends.first].push_back(ends.second);
      neighbours[ends.second].push_back(ends.first);
    }
  std::optional<double> lowest;
  for (const Chain& chain : chains_of(neighbours)) {
    double sum = 0, length = 0;
    const std::size_t count = chain.members.size();
    for (std::size_t i = 0; i + 1 < count + (chain.closed ? 1 : 0); ++i) {
      const Vec3 &a = garment.vertices[chain.members[i]], &b = garment.vertices[chain.members[(i + 1) % count]];
      sum += (b - a).norm() * (a.y() + b.y()) / 2;
      length += (b - a).norm();
    }
    if (length > 0 && (!lowest || sum / length < *lowest)) lowest = sum / length;
  }
  return lowest;
}

}  // namespace vitrine
