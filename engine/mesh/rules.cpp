// SPDX-License-Identifier: GPL-3.0-or-later
#include "rules.hpp"

#include <algorithm>
#include <array>

#include "magnets.hpp"

namespace vitrine::mesh_room {
namespace {

constexpr double kFlat = 1.3, kMiddling = 1.6;  ///< [-] the paper's edge-ratio bounds
/// Halving an edge must not go below the target: the halves of a longer one are nearer to it than the whole.
constexpr double kLong = 1.42;
constexpr double kClose = 0.62;  ///< [-] shorter interior edges, in target edges, are merged

struct Shape {
  std::array<double, 3> length;  ///< of the edge opposite to corner k
  int longest;
  double ratio;
};

Shape shape_of(const std::vector<Vec2>& nodes, const Triangle& t) {
  Shape s;
  for (int k = 0; k < 3; ++k) s.length[k] = (nodes[t[(k + 1) % 3]] - nodes[t[(k + 2) % 3]]).norm();
  s.longest = static_cast<int>(std::max_element(s.length.begin(), s.length.end()) - s.length.begin());
  const double sum = s.length[0] + s.length[1] + s.length[2];
  s.ratio = (sum - s.length[s.longest]) / s.length[s.longest];
  return s;
}

/// The changes of one round, and which nodes they concern.
class Round {
 public:
  Round(std::vector<Vec2>& nodes, std::size_t outline_size, const Wall& wall, double h, std::size_t max_nodes)
      : nodes_(nodes), outline_(outline_size), wall_(wall), h_(h), max_nodes_(max_nodes) {
    removed_.assign(nodes.size(), false);
    touched_.assign(nodes.size(), false);
  }

  bool interior(std::uint32_t i) const { return i >= outline_; }
  /// Outline segments join neighbours in the order of the outline; any other edge may be split.
  bool wall_segment(std::uint32_t a, std::uint32_t b) const {
    if (interior(a) || interior(b)) return false;
    const std::size_t gap = a < b ? b - a : a - b;
    return gap == 1 || gap + 1 == outline_;
  }
  bool untouched(const Triangle& t) const { return !touched_[t[0]] && !touched_[t[1]] && !touched_[t[2]]; }

  void remove(std::uint32_t i) {
    removed_[i] = true;
    ++changes_;
  }
  /// The midpoint of an edge, unless it lies on or too near to the wall.
  bool insert_middle(std::uint32_t a, std::uint32_t b) {
    if (wall_segment(a, b) || nodes_.size() + added_.size() >= max_nodes_) return false;
    const Vec2 p = 0.5 * (nodes_[a] + nodes_[b]);
    if (wall_.distance(p, h_) < kClearance * h_) return false;
    added_.push_back(p);
    ++changes_;
    return true;
  }
  void move(std::uint32_t i, const Vec2& p) { nodes_[i] = p; }
  void touch(const Triangle& t) {
    for (std::uint32_t i : t) touched_[i] = true;
  }
  bool touched(std::uint32_t i) const { return touched_[i]; }

  int finish() {
    std::size_t kept = outline_;
    for (std::size_t i = outline_; i < nodes_.size(); ++i)
      if (!removed_[i]) nodes_[kept++] = nodes_[i];
    nodes_.resize(kept);
    nodes_.insert(nodes_.end(), added_.begin(), added_.end());
    return changes_;
  }

 private:
  std::vector<Vec2>& nodes_;
  std::size_t outline_;
  const Wall& wall_;
  double h_;
  std::size_t max_nodes_;
  std::vector<char> removed_, touched_;
  std::vector<Vec2> added_;
  int changes_ = 0;
};

/// The rules for one triangle; false when nothing could be done.
bool repair(Round& round, const Triangle& t, const Shape& s, double h) {
  const std::uint32_t opposite = t[s.longest], a = t[(s.longest + 1) % 3], b = t[(s.longest + 2) % 3];
  const bool is_long = s.length[s.longest] > kLong * h;
  if (s.ratio < kFlat) {
    const bool inserted = round.insert_middle(a, b);
    const bool removed = round.interior(opposite);
    if (removed) round.remove(opposite);
    return inserted || removed;
  }
  if (!is_long) return false;
  if (s.ratio <= kMiddling) return round.insert_middle(a, b);
  bool any = false;
  for (int k = 0; k < 3; ++k)
    if (s.length[k] > kLong * h) any |= round.insert_middle(t[(k + 1) % 3], t[(k + 2) % 3]);
  return any;
}

/// Two close interior neighbours become one in their middle.
void merge_close(Round& round, const std::vector<Vec2>& nodes, const std::vector<Triangle>& triangles, const Wall& wall,
                 double h) {
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (!round.interior(a) || !round.interior(b) || round.touched(a) || round.touched(b)) continue;
      if ((nodes[a] - nodes[b]).norm() > kClose * h) continue;
      const Vec2 middle = 0.5 * (nodes[a] + nodes[b]);
      round.touch(t);
      if (wall.distance(middle, h) >= kClearance * h) round.move(a, middle);
      round.remove(b);
    }
}

}  // namespace

int apply_edge_ratio_rules(std::vector<Vec2>& nodes, std::size_t outline_size, const std::vector<Triangle>& triangles,
                           const Wall& wall, double edge_length, std::size_t max_nodes) {
  struct Candidate {
    double ratio;
    std::size_t triangle;
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Shape s = shape_of(nodes, triangles[i]);
    if (s.ratio < kFlat || s.length[s.longest] > kLong * edge_length) candidates.push_back({s.ratio, i});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.ratio < b.ratio; });

  Round round(nodes, outline_size, wall, edge_length, max_nodes);
  for (const Candidate& c : candidates) {
    const Triangle& t = triangles[c.triangle];
    if (round.untouched(t) && repair(round, t, shape_of(nodes, t), edge_length)) round.touch(t);
  }
  merge_close(round, nodes, triangles, wall, edge_length);
  return round.finish();
}

}  // namespace vitrine::mesh_room
