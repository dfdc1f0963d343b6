// SPDX-License-Identifier: GPL-3.0-or-later
#include "simple.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vitrine::panels_room {
namespace {

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// > 0 when c lies to the left of a -> b.
double side(const Vec2& a, const Vec2& b, const Vec2& c) {
  return cross(b - a, c - a);
}

bool within(const Vec2& a, const Vec2& b, const Vec2& p) {
  return p.x() >= std::min(a.x(), b.x()) && p.x() <= std::max(a.x(), b.x()) && p.y() >= std::min(a.y(), b.y()) &&
         p.y() <= std::max(a.y(), b.y());
}

bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double c1 = side(a, b, c), d1 = side(a, b, d), a1 = side(c, d, a), b1 = side(c, d, b);
  if (((c1 > 0 && d1 < 0) || (c1 < 0 && d1 > 0)) && ((a1 > 0 && b1 < 0) || (a1 < 0 && b1 > 0))) return true;
  return (c1 == 0 && within(a, b, c)) || (d1 == 0 && within(a, b, d)) || (a1 == 0 && within(c, d, a)) ||
         (b1 == 0 && within(c, d, b));
}

/// Pairs of segments whose boxes overlap after growing by `margin`, by a sweep over x.
template <class Visit>
void close_segments(const std::vector<Vec2>& outline, double margin, Visit&& visit) {
  const int n = static_cast<int>(outline.size());
  const auto end = [&](int i) -> const Vec2& { return outline[i + 1 == n ? 0 : i + 1]; };
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  const auto left = [&](int i) { return std::min(outline[i].x(), end(i).x()); };
  const auto right = [&](int i) { return std::max(outline[i].x(), end(i).x()); };
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return left(i) < left(j); });
  for (std::size_t a = 0; a < order.size(); ++a)
    for (std::size_t b = a + 1; b < order.size() && left(order[b]) <= right(order[a]) + margin; ++b) {
      const int i = std::min(order[a], order[b]), j = std::max(order[a], order[b]);
      const auto [low_i, high_i] = std::minmax(outline[i].y(), end(i).y());
      const auto [low_j, high_j] = std::minmax(outline[j].y(), end(j).y());
      if (low_i <= high_j + margin && low_j <= high_i + margin) visit(i, j);
    }
}

/// Lays the nodes strictly between `from` and `to` (walking forward) evenly on the straight line between them.
bool straighten(std::vector<Vec2>& outline, const std::vector<bool>& fixed, int from, int to) {
  const int n = static_cast<int>(outline.size()), count = (to - from + n) % n;
  for (int k = 1; k < count; ++k)
    if (fixed[(from + k) % n]) return false;
  for (int k = 1; k < count; ++k) {
    const double t = static_cast<double>(k) / count;
    outline[(from + k) % n] = (1 - t) * outline[from] + t * outline[to];
  }
  return count > 1;
}

/// A node that lies on the wrong side of the other of two crossing segments, by `depth` [m].
struct Intruder {
  int node, segment;  ///< the segment is left on its right side, away from the cloth
  double depth, along;
  Vec2 out;
};

/// The ends of both crossing segments that reach into the other's cloth, the shallowest first: a corner that pokes
/// through an edge reaches less deep into it than the edge reaches past the corner's own sides.
std::vector<Intruder> intruders(const std::vector<Vec2>& outline, int i, int j) {
  const int n = static_cast<int>(outline.size());
  std::vector<Intruder> found;
  for (const auto& [from, segment] : {std::pair{i, j}, std::pair{j, i}})
    for (const int node : {from, (from + 1) % n}) {
      const int next = (segment + 1) % n;
      const Vec2 d = outline[next] - outline[segment], way = outline[node] - outline[segment];
      const double length = d.norm();
      if (!(length > 0) || node == segment || node == next) continue;
      const Vec2 out = Vec2(d.y(), -d.x()) / length;
      const double depth = -way.dot(out);
      if (depth >= 0) found.push_back({node, segment, depth, way.dot(d) / (length * length), out});
    }
  std::stable_sort(found.begin(), found.end(), [](const Intruder& a, const Intruder& b) { return a.depth < b.depth; });
  return found;
}

/// Pushes the two sides of a crossing apart until `gap` lies between them; what is fixed leaves the way to the other.
bool part_crossing(std::vector<Vec2>& outline, const std::vector<bool>& fixed, int i, int j, double gap,
                   double farthest) {
  const int n = static_cast<int>(outline.size());
  for (const Intruder& p : intruders(outline, i, j)) {
    if (p.depth > farthest) break;
    const int a = p.segment, b = (a + 1) % n;
    const double t = std::clamp(p.along, 0.0, 1.0), needed = p.depth + gap;
    // How far the segment gives way at the node's foot for one metre of each free end.
    const double give = (fixed[a] ? 0 : 1 - t) + (fixed[b] ? 0 : t);
    if (fixed[p.node] && give < 0.15) continue;
    const double own = fixed[p.node] ? 0 : give < 0.15 ? 1 : 0.5;
    outline[p.node] += own * needed * p.out;
    const Vec2 yield = own < 1 ? Vec2(-(1 - own) * needed / give * p.out) : Vec2(Vec2::Zero());
    if (!fixed[a]) outline[a] += yield;
    if (!fixed[b]) outline[b] += yield;
    return true;
  }
  return false;
}

double stretch_length(const std::vector<Vec2>& outline, int from, int to) {
  const int n = static_cast<int>(outline.size());
  double length = 0;
  for (int i = from; i != to; i = (i + 1) % n) length += (outline[(i + 1) % n] - outline[i]).norm();
  return length;
}

}  // namespace

std::optional<std::pair<int, int>> find_crossing(const std::vector<Vec2>& outline) {
  const int n = static_cast<int>(outline.size());
  std::optional<std::pair<int, int>> first;
  close_segments(outline, 0, [&](int i, int j) {
    const std::pair<int, int> pair{i, j};
    if (first && *first <= pair) return;
    const Vec2 &a = outline[i], &b = outline[(i + 1) % n], &c = outline[j], &d = outline[(j + 1) % n];
    bool meet;
    if (j == i + 1) {
      meet = side(a, b, d) == 0 && (a - b).dot(d - b) >= 0;
    } else if (i == 0 && j == n - 1) {
      meet = side(a, b, c) == 0 && (b - a).dot(c - a) >= 0;
    } else {
      meet = segments_meet(a, b, c, d);
    }
    if (meet) first = pair;
  });
  return first;
}

bool untangle(std::vector<Vec2>& outline, const std::vector<bool>& fixed, double largest_loop, double gap) {
  const int n = static_cast<int>(outline.size());
  for (int attempt = 0; attempt < 400; ++attempt) {
    const auto crossing = find_crossing(outline);
    if (!crossing) return true;
    // Segment i runs i -> i+1; the loop is what lies between the two crossing segments, on the shorter way round.
    int from = crossing->first, to = (crossing->second + 1) % n;
    const double inside = stretch_length(outline, from, to);
    const double around = stretch_length(outline, crossing->second, (crossing->first + 1) % n);
    if (around < inside) {
      from = crossing->second;
      to = (crossing->first + 1) % n;
    }
    if (std::min(inside, around) <= largest_loop && straighten(outline, fixed, from, to)) continue;
    // Two stretches that only lie side by side (a sleeve along the body) change sides again and again: no loop.
    if (!part_crossing(outline, fixed, crossing->first, crossing->second, gap, 0.25 * largest_loop)) return false;
  }
  return !find_crossing(outline);
}

void open_slits(std::vector<Vec2>& outline, const std::vector<bool>& fixed, double gap) {
  const int n = static_cast<int>(outline.size());
  for (int pass = 0; pass < 40; ++pass) {
    std::vector<Vec2> push(n, Vec2::Zero());
    bool any = false;
    const auto repel = [&](int p, int s) {  // node p from segment s
      const int t = (s + 1) % n;
      if (p == s || p == t) return;
      const Vec2 &a = outline[s], &b = outline[t], d = b - a;
      const double length = d.norm();
      if (!(length > 0)) return;
      const double along = (outline[p] - a).dot(d) / (length * length);
      if (along < -0.05 || along > 1.05) return;
      // The inside is on the left: a slit has the other stretch on the right, running the other way.
      const Vec2 out = Vec2(d.y(), -d.x()) / length;
      const Vec2 own = outline[(p + 1) % n] - outline[(p + n - 1) % n];
      const double distance = (outline[p] - a).dot(out);
      if (own.dot(d) >= -0.5 * own.norm() * length || distance >= gap || distance <= -0.5 * gap) return;
      const Vec2 move = 0.5 * (gap - distance) * out;
      // The segment's own ends give way as well; each takes the largest push asked of it.
      const auto take = [&](int i, const Vec2& v) {
        if (!fixed[i] && v.norm() > push[i].norm()) push[i] = v;
      };
      take(p, move);
      take(along < 0.5 ? s : t, -move);
      any = true;
    };
    close_segments(outline, gap, [&](int i, int j) {
      repel(i, j);
      repel((i + 1) % n, j);
      repel(j, i);
      repel((j + 1) % n, i);
    });
    if (!any) return;
    for (int i = 0; i < n; ++i) outline[i] += 0.7 * push[i];
  }
}

}  // namespace vitrine::panels_room
