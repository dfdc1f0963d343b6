// SPDX-License-Identifier: GPL-3.0-or-later
#include "rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace vitrine::mesh_room {
namespace {

constexpr double kFlat = 1.3;  ///< [-] the paper's bound for the edge ratio of flat triangles
/// Halving an edge must not go below the target: the halves of a longer one are nearer to it than the whole.
constexpr double kLong = 1.42;
constexpr double kClose = 0.62;  ///< [-] shorter interior edges, in target edges, are merged

constexpr double kSharp = 0.342;  ///< [-] sine of 20 degrees

/// Sine of the smallest angle of a counter-clockwise triangle: twice the area over its two longer edges.
double smallest_sine(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = b - a, v = c - b, w = a - c;
  const double p = u.squaredNorm(), q = v.squaredNorm(), r = w.squaredNorm();
  const double shortest = std::min({p, q, r});
  return (u.x() * v.y() - u.y() * v.x()) * std::sqrt(shortest / (p * q * r));
}

struct Shape {
  std::array<double, 3> length;  ///< of the edge opposite to corner k, in target edges
  int longest;
  double ratio;
};

Shape shape_of(const Sheet& sheet, const Triangle& t) {
  Shape s;
  const double target = (sheet.size(t[0]) + sheet.size(t[1]) + sheet.size(t[2])) / 3;
  for (int k = 0; k < 3; ++k) s.length[k] = (sheet.at(t[(k + 1) % 3]) - sheet.at(t[(k + 2) % 3])).norm() / target;
  s.longest = static_cast<int>(std::max_element(s.length.begin(), s.length.end()) - s.length.begin());
  s.ratio = (s.length[0] + s.length[1] + s.length[2] - s.length[s.longest]) / s.length[s.longest];
  return s;
}

/// The changes of one round, and which nodes they concern.
class Round {
 public:
  Round(Sheet& sheet, const Ground& ground, std::vector<std::uint32_t>& ring)
      : sheet_(sheet), ground_(ground), ring_(ring), touched_(sheet.node_slots(), 0) {}

  bool untouched(const Triangle& t) const { return !touched_[t[0]] && !touched_[t[1]] && !touched_[t[2]]; }
  bool touched(std::uint32_t i) const { return touched_[i]; }
  void touch(std::uint32_t i) {
    sheet_.star(i, [&](std::uint32_t b, std::uint32_t c) { touched_[b] = touched_[c] = 1; });
    touched_[i] = 1;
  }
  bool remove(std::uint32_t i) {
    if (!sheet_.interior(i)) return false;
    touch(i);
    return sheet_.remove(i);
  }
  /// A node in the middle of the edge opposite to corner k, unless it would be too near to the wall.
  bool split(std::int32_t cell, int k) {
    const Triangle t = sheet_.cells()[cell].node;
    const std::uint32_t a = t[(k + 1) % 3], b = t[(k + 2) % 3];
    if (sheet_.cells()[cell].next[k] == Sheet::kNone) return false;
    if (!ground_.is_clear(0.5 * (sheet_.at(a) + sheet_.at(b)), 0.5 * (sheet_.size(a) + sheet_.size(b)))) return false;
    for (const std::uint32_t i : t) touch(i);
    const auto made = static_cast<std::uint32_t>(sheet_.split(cell, k));
    touched_.push_back(1);
    ring_.push_back(made);
    sheet_.legalise(made);
    return true;
  }
  /// The rules for one triangle.
  int repair(std::int32_t cell) {
    const Triangle t = sheet_.cells()[cell].node;
    const Shape s = shape_of(sheet_, t);
    const bool is_long = s.length[s.longest] > kLong;
    if (s.ratio < kFlat) {
      const std::uint32_t opposite = t[s.longest];
      const bool inserted = is_long && split(cell, s.longest);
      return inserted + remove(opposite);
    }
    // Above 1.6 the paper splits every edge; here the longest, for that changes the triangle the others belonged to,
    // and the next round sees to them.
    return is_long && split(cell, s.longest);
  }
  /// Two close interior neighbours become one in their middle.
  int merge(std::uint32_t a, std::uint32_t b) {
    if (!sheet_.interior(a) || !sheet_.interior(b) || touched_[a] || touched_[b]) return 0;
    const Vec2 middle = 0.5 * (sheet_.at(a) + sheet_.at(b));
    touch(a);
    if (!remove(b)) return 0;
    const Vec2 before = sheet_.at(a);
    sheet_.move(a, middle);
    bool fits = true;
    sheet_.star(a, [&](std::uint32_t c, std::uint32_t d) {
      const Vec2 u = sheet_.at(c) - middle, v = sheet_.at(d) - middle;
      fits = fits && u.x() * v.y() - u.y() * v.x() > 0;
    });
    if (!fits) sheet_.move(a, before);
    return 1;
  }

 private:
  Sheet& sheet_;
  const Ground& ground_;
  std::vector<std::uint32_t>& ring_;
  std::vector<char> touched_;
};

}  // namespace

int apply_edge_ratio_rules(Sheet& sheet, const Ground& ground, std::vector<std::uint32_t>& ring) {
  std::vector<char> ours(sheet.node_slots(), 0);
  for (std::uint32_t i = 0; i < sheet.wall_size(); ++i) ours[i] = 1;
  for (const std::uint32_t i : ring) ours[i] = 1;
  struct Candidate {
    double ratio;
    std::int32_t cell;
    Triangle node;
  };
  std::vector<Candidate> candidates;
  std::vector<std::array<std::uint32_t, 2>> close;
  for (std::size_t c = 0; c < sheet.cells().size(); ++c) {
    if (!sheet.cell_alive(c)) continue;
    const Triangle& t = sheet.cells()[c].node;
    if (!ours[t[0]] && !ours[t[1]] && !ours[t[2]]) continue;
    const Shape s = shape_of(sheet, t);
    if (s.ratio < kFlat || s.length[s.longest] > kLong)
      candidates.push_back({s.ratio, static_cast<std::int32_t>(c), t});
    for (int k = 0; k < 3; ++k)
      if (s.length[k] < kClose) close.push_back({t[(k + 1) % 3], t[(k + 2) % 3]});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.ratio < b.ratio; });
  Round round(sheet, ground, ring);
  int changes = 0;
  for (const Candidate& c : candidates)
    if (round.untouched(c.node) && sheet.cells()[c.cell].node == c.node) changes += round.repair(c.cell);
  for (const auto& [a, b] : close) changes += round.merge(a, b);
  std::erase_if(ring, [&](std::uint32_t i) { return !sheet.alive(i); });
  return changes;
}

void relieve_sharp_triangles(Sheet& sheet, std::vector<std::uint32_t>& ring) {
  const std::size_t count = sheet.cells().size();
  for (std::size_t c = 0; c < count; ++c) {
    if (!sheet.cell_alive(c)) continue;
    const Sheet::Cell cell = sheet.cells()[c];
    if (sheet.interior(cell.node[0]) && sheet.interior(cell.node[1]) && sheet.interior(cell.node[2])) continue;
    const Vec2 p[] = {sheet.at(cell.node[0]), sheet.at(cell.node[1]), sheet.at(cell.node[2])};
    if (smallest_sine(p[0], p[1], p[2]) > kSharp) continue;
    int longest = -1;
    double length = 0;
    for (int k = 0; k < 3; ++k) {
      const double l = (p[(k + 1) % 3] - p[(k + 2) % 3]).squaredNorm();
      if (cell.next[k] == Sheet::kNone || l <= length) continue;
      length = l;
      longest = k;
    }
    if (longest < 0) continue;
    const Vec2 &near = p[longest], &a = p[(longest + 1) % 3], &b = p[(longest + 2) % 3];
    const Vec2 &far = sheet.at(sheet.opposite(static_cast<std::int32_t>(c), longest)), m = 0.25 * (near + far + a + b);
    const double before = std::min(smallest_sine(near, a, b), smallest_sine(far, b, a));
    const double after = std::min(
        {smallest_sine(near, a, m), smallest_sine(near, m, b), smallest_sine(far, b, m), smallest_sine(far, m, a)});
    if (after <= before) continue;
    const auto made = static_cast<std::uint32_t>(sheet.split(static_cast<std::int32_t>(c), longest));
    sheet.move(made, m);
    sheet.legalise(made);
    ring.push_back(made);
  }
}

}  // namespace vitrine::mesh_room
