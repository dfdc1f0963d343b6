// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>

namespace vitrine::sewing {
namespace {

constexpr double tiny_area = 1e-10;  // [m^2]
// Hems, cuffs, waistbands and neck bands are folded or bound: two or three layers of cloth that bend as one.
constexpr double band = 0.02;        // [m] wide
constexpr double band_stiffer = 10;  // [-] two layers would come to 8, three to 27
constexpr double pi2 = std::numbers::pi * std::numbers::pi;

/// One side of a triangle, seen from the triangle.
struct HalfEdge {
  int a = 0, b = 0;             // cloth nodes, a < b
  int opposite = 0;             // cloth node
  double cot_a = 0, cot_b = 0;  // of the triangle's angles at a and b
  double area = 0;              // of the triangle
  double rest = 0;              // length
  double k = 0;                 // K(direction)
};

/// Warp and weft take `stretch`, the bias takes `shear`.
double directional(const SheetStiffness& s, const Vec2& d, double length) {
  const double sin2 = 2 * d.x() * d.y() / (length * length);
  const double share = std::min(1.0, sin2 * sin2);
  return s.stretch + (s.shear - s.stretch) * share;
}

/// Cotangents of needle triangles are bounded: an almost flat corner must not become an almost rigid hinge.
double cotangent(const Vec2& u, const Vec2& v) {
  const double cross = std::abs(u.x() * v.y() - u.y() * v.x()), dot = u.dot(v);
  return std::clamp(dot / std::max(cross, 1e-12), -5.0, 5.0);
}

void collect(const Pattern& pattern, const Nodes& nodes, const SheetStiffness& sheet, std::vector<HalfEdge>& out) {
  for (std::size_t p = 0; p < pattern.meshes.size(); ++p) {
    const auto& mesh = pattern.meshes[p];
    for (const Triangle& t : mesh.triangles) {
      const Vec2 q[3] = {mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]]};
      const Vec2 u = q[1] - q[0], w = q[2] - q[0];
      const double area = 0.5 * std::abs(u.x() * w.y() - u.y() * w.x());
      for (int e = 0; e < 3; ++e) {
        const int i = e, j = (e + 1) % 3, o = (e + 2) % 3;
        HalfEdge h;
        h.a = static_cast<int>(nodes[p][t[i]]);
        h.b = static_cast<int>(nodes[p][t[j]]);
        h.opposite = static_cast<int>(nodes[p][t[o]]);
        if (h.a == h.b) continue;  // a triangle whose own corners are sewn together
        const Vec2 d = q[j] - q[i];
        h.rest = d.norm();
        if (h.rest < tiny_length) continue;
        h.cot_a = cotangent(q[j] - q[i], q[o] - q[i]);
        h.cot_b = cotangent(q[i] - q[j], q[o] - q[j]);
        h.area = area;
        h.k = directional(sheet, d, h.rest);
        if (h.a > h.b) {
          std::swap(h.a, h.b);
          std::swap(h.cot_a, h.cot_b);
        }
        out.push_back(h);
      }
    }
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const HalfEdge& l, const HalfEdge& r) { return l.a != r.a ? l.a < r.a : l.b < r.b; });
}

void add_hinge(Cloth& c, const HalfEdge& s, const HalfEdge& t, double bend) {
  const double area = s.area + t.area;
  if (area < tiny_area || s.opposite == t.opposite) return;
  // Bergou et al. 2006: E = (B/2) * w/(A0+A1) * |sum K_j x_j|^2, there with w = 3. Here w = 1: with it a cylinder costs
  // B/2 * curvature^2 per area on square and on equilateral meshes, which is what the rigidity B of a cloth means.
  const double k[4] = {s.cot_b + t.cot_b, s.cot_a + t.cot_a, -(s.cot_a + s.cot_b), -(t.cot_a + t.cot_b)};
  c.hinge.insert(c.hinge.end(), {s.a, s.b, s.opposite, t.opposite});
  c.hinge_k.push_back(bend / area);
  c.hinge_c.insert(c.hinge_c.end(), k, k + 4);
}

/// Per cloth node: distance along mesh edges to the nearest open edge of the garment [m], as far as `reach`.
std::vector<double> from_open_edges(const Pattern& pattern, const Nodes& nodes, int count, double reach) {
  std::vector<double> far(count, std::numeric_limits<double>::infinity());
  std::set<std::pair<int, int>> sewn;
  for (const NodePair& q : pattern.pairs) sewn.insert({q.panel_a, q.node_a}), sewn.insert({q.panel_b, q.node_b});
  for (std::size_t p = 0; p < pattern.panels.size(); ++p) {
    const int n = static_cast<int>(pattern.panels[p].outline.size());
    // The ends of a seam belong to the open edge beside it, too; an outline node whose neighbours are both sewn does
    // not.
    for (int i = 0; i < n; ++i) {
      const int panel = static_cast<int>(p);
      if (!sewn.count({panel, i}) || !sewn.count({panel, (i + 1) % n}) || !sewn.count({panel, (i + n - 1) % n}))
        far[nodes[p][i]] = 0;
    }
  }
  bool changed = true;
  while (changed) {
    changed = false;
    for (std::size_t p = 0; p < pattern.meshes.size(); ++p)
      for (const Triangle& t : pattern.meshes[p].triangles)
        for (int e = 0; e < 3; ++e) {
          const int i = e, j = (e + 1) % 3;
          const auto a = nodes[p][t[i]], b = nodes[p][t[j]];
          const double length = (pattern.meshes[p].nodes[t[i]] - pattern.meshes[p].nodes[t[j]]).norm();
          for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}})
            if (far[from] + length < far[to] && far[from] + length <= reach)
              far[to] = far[from] + length, changed = true;
        }
  }
  return far;
}

void sum_masses(Cloth& c, const Pattern& pattern, const Nodes& nodes, double density) {
  for (std::size_t p = 0; p < pattern.meshes.size(); ++p) {
    const auto& mesh = pattern.meshes[p];
    for (const Triangle& t : mesh.triangles) {
      const Vec2 u = mesh.nodes[t[1]] - mesh.nodes[t[0]], w = mesh.nodes[t[2]] - mesh.nodes[t[0]];
      const double third = std::abs(u.x() * w.y() - u.y() * w.x()) / 6;
      std::array<int, 3> tri;
      for (int i = 0; i < 3; ++i) {
        tri[i] = static_cast<int>(nodes[p][t[i]]);
        c.area[tri[i]] += third;
        c.mass[tri[i]] += density * third;
      }
      // The back panel's outside faces -Z: its triangles are turned over.
      if (p == 1) std::swap(tri[1], tri[2]);
      c.triangles.push_back(tri);
    }
  }
}

/// What residuals are divided by.
void weigh(Cloth& c) {
  double springs = 0;
  for (std::size_t e = 0; e < c.edge_k.size(); ++e) springs += c.edge_k[e] * c.edge_rest[e];
  c.weight = 0;
  for (const double m : c.mass) c.weight += m * c.gravity;
  c.scale = std::max(c.weight, 1e-6 * springs);
}

}  // namespace

double mean_edge(const Pattern& p) {
  double sum = 0;
  std::size_t count = 0;
  for (const PanelMesh& m : p.meshes)
    for (const Triangle& t : m.triangles)
      for (int e = 0; e < 3; ++e, ++count) sum += (m.nodes[t[e]] - m.nodes[t[(e + 1) % 3]]).norm();
  return std::max(sum / static_cast<double>(count), 1e-4);
}

Nodes number_nodes(const Pattern& pattern, std::span<const char> weld, int& count) {
  std::vector<int> base(1, 0);
  for (const auto& m : pattern.meshes) base.push_back(base.back() + static_cast<int>(m.nodes.size()));
  const int total = base.back();
  std::vector<int> parent(total);
  std::iota(parent.begin(), parent.end(), 0);
  auto find = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (std::size_t s = 0; s < pattern.pairs.size(); ++s) {
    if (!weld[s]) continue;
    const NodePair& q = pattern.pairs[s];
    const int a = find(base[q.panel_a] + q.node_a), b = find(base[q.panel_b] + q.node_b);
    // The smaller number stays, whatever the order of the pairs.
    if (a != b) parent[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::vector<int>> neighbours(total);
  for (std::size_t p = 0; p < pattern.meshes.size(); ++p)
    for (const Triangle& t : pattern.meshes[p].triangles)
      for (int e = 0; e < 3; ++e) {
        const int a = find(base[p] + static_cast<int>(t[e])), b = find(base[p] + static_cast<int>(t[(e + 1) % 3]));
        neighbours[a].push_back(b);
        neighbours[b].push_back(a);
      }
  std::vector<int> number(total, -1), queue;
  count = 0;
  for (int seed = 0; seed < total; ++seed) {
    if (find(seed) != seed || number[seed] >= 0) continue;
    queue.assign(1, seed);
    number[seed] = count++;
    for (std::size_t head = 0; head < queue.size(); ++head)
      for (int n : neighbours[queue[head]])
        if (number[n] < 0) {
          number[n] = count++;
          queue.push_back(n);
        }
  }
  Nodes nodes(pattern.meshes.size());
  for (std::size_t p = 0; p < nodes.size(); ++p)
    for (int i = base[p]; i < base[p + 1]; ++i) nodes[p].push_back(static_cast<std::uint32_t>(number[find(i)]));
  return nodes;
}

Cloth build_cloth(const Pattern& pattern, const Nodes& nodes, int count, const Positions& start,
                  const SheetStiffness& sheet, double density, double gravity, bool bending) {
  Cloth c;
  c.size = count;
  c.x.assign(3 * static_cast<std::size_t>(count), 0.0);
  c.mass.assign(count, 0.0);
  c.area.assign(count, 0.0);
  c.side.assign(count, 0.0);
  c.pinned.assign(count, 0);
  c.gravity = gravity;

  std::vector<int> members(count, 0);
  for (std::size_t p = 0; p < nodes.size(); ++p)
    for (std::size_t i = 0; i < nodes[p].size(); ++i) {
      const auto n = nodes[p][i];
      ++members[n];
      for (int a = 0; a < 3; ++a) c.x[3 * n + a] += start[p][i][a];
      c.side[n] += p == 0 ? 1.0 : -1.0;
    }
  for (int n = 0; n < count; ++n) {
    for (int a = 0; a < 3; ++a) c.x[3 * n + a] /= std::max(1, members[n]);
    c.side[n] /= std::max(1, members[n]);
  }
  sum_masses(c, pattern, nodes, density);

  std::vector<HalfEdge> halves;
  collect(pattern, nodes, sheet, halves);
  const std::vector<double> far = from_open_edges(pattern, nodes, count, 2 * band);
  for (std::size_t i = 0; i < halves.size();) {
    std::size_t end = i;
    double k = 0, pull = 0, area = 0;
    while (end < halves.size() && halves[end].a == halves[i].a && halves[end].b == halves[i].b) {
      // Springs side by side: stiffness adds, the rest length is the one at which their forces cancel.
      const HalfEdge& h = halves[end++];
      const double share = h.k * h.area / (h.rest * h.rest);
      k += share;
      pull += share * h.rest;
      area += h.area;
    }
    const bool in_band = far[halves[i].a] + far[halves[i].b] <= 2 * band;
    const double bend = bending ? sheet.bend * (in_band ? band_stiffer : 1) : 0;
    if (k > 0) {
      const double rest = pull / k;
      c.edge_a.push_back(halves[i].a);
      c.edge_b.push_back(halves[i].b);
      c.edge_k.push_back(k);
      c.edge_rest.push_back(rest);
      if (bend > 0) c.edge_buckles.push_back(pi2 * bend * area / (rest * rest * rest) / k);
    }
    if (bend > 0)
      for (std::size_t j = i; j + 1 < end; ++j) add_hinge(c, halves[j], halves[j + 1], bend);
    i = end;
  }
  weigh(c);
  return c;
}

void set_raw_constants(Cloth& c, double k, double m) {
  if (k > 0) std::fill(c.edge_k.begin(), c.edge_k.end(), k), c.edge_buckles.clear();
  if (m > 0) std::fill(c.mass.begin(), c.mass.end(), m);
  weigh(c);
}

double internal_forces(const Cloth& c, const std::vector<double>& x, std::vector<double>& force) {
  double energy = 0;
  if (c.gravity != 0)
    for (int n = 0; n < c.size; ++n) {
      const double w = c.mass[n] * c.gravity;
      force[3 * n + 1] -= w;
      energy += w * x[3 * n + 1];
    }
  const std::size_t edges = c.edge_k.size();
  for (std::size_t e = 0; e < edges; ++e) {
    const double* p = &x[3 * c.edge_a[e]];
    const double* q = &x[3 * c.edge_b[e]];
    double* f = &force[3 * c.edge_a[e]];
    double* g = &force[3 * c.edge_b[e]];
    const double dx = q[0] - p[0], dy = q[1] - p[1], dz = q[2] - p[2];
    const double length = std::sqrt(dx * dx + dy * dy + dz * dz);
    const double stretch = length - c.edge_rest[e];
    const double buckled = c.edge_buckles.empty() ? 0.0 : std::min(0.0, stretch + c.edge_buckles[e]);
    energy += 0.5 * c.edge_k[e] * (stretch * stretch - (1 - buckled_share) * buckled * buckled);
    if (length < tiny_length) continue;  // no direction: the neighbours will pull it apart
    const double s = c.edge_k[e] * (stretch - (1 - buckled_share) * buckled) / length;
    f[0] += s * dx, f[1] += s * dy, f[2] += s * dz;
    g[0] -= s * dx, g[1] -= s * dy, g[2] -= s * dz;
  }
  const std::size_t hinges = c.hinge_k.size();
  for (std::size_t h = 0; h < hinges; ++h) {
    const int* n = &c.hinge[4 * h];
    const double* k = &c.hinge_c[4 * h];
    double v[3];
    for (int a = 0; a < 3; ++a)
      v[a] = k[0] * x[3 * n[0] + a] + k[1] * x[3 * n[1] + a] + k[2] * x[3 * n[2] + a] + k[3] * x[3 * n[3] + a];
    energy += 0.5 * c.hinge_k[h] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int j = 0; j < 4; ++j) {
      const double s = c.hinge_k[h] * k[j];
      double* f = &force[3 * n[j]];
      f[0] -= s * v[0], f[1] -= s * v[1], f[2] -= s * v[2];
    }
  }
  for (const SeamSpring& s : c.seams) {
    double d[3], gap = 0;
    for (int a = 0; a < 3; ++a) d[a] = x[3 * s.b + a] - x[3 * s.a + a], gap += d[a] * d[a];
    gap = std::sqrt(gap);
    // Linear up to the cap, constant beyond: an energy with one continuous force.
    const double reach = s.k > 0 ? s.cap / s.k : 0;
    energy += gap <= reach ? 0.5 * s.k * gap * gap : s.cap * (gap - 0.5 * reach);
    const double pull = gap <= reach ? s.k : s.cap / std::max(gap, tiny_length);
    for (int a = 0; a < 3; ++a) force[3 * s.a + a] += pull * d[a], force[3 * s.b + a] -= pull * d[a];
  }
  return energy;
}

std::vector<double> node_stiffness(const Cloth& c) {
  std::vector<double> s(c.size, 0.0);
  for (std::size_t e = 0; e < c.edge_k.size(); ++e) {
    s[c.edge_a[e]] += c.edge_k[e];
    s[c.edge_b[e]] += c.edge_k[e];
  }
  for (std::size_t h = 0; h < c.hinge_k.size(); ++h) {
    double row = 0;
    for (int j = 0; j < 4; ++j) row += std::abs(c.hinge_c[4 * h + j]);
    // A spring's row sums to 2k and counts as k: the same half for hinges.
    for (int j = 0; j < 4; ++j) s[c.hinge[4 * h + j]] += 0.5 * c.hinge_k[h] * std::abs(c.hinge_c[4 * h + j]) * row;
  }
  for (const SeamSpring& z : c.seams) s[z.a] += z.k, s[z.b] += z.k;
  // A node without any spring still needs a mass; its neighbours' largest is the gentlest choice.
  const double most = s.empty() ? 0.0 : *std::max_element(s.begin(), s.end());
  for (double& v : s)
    if (!(v > 0)) v = most > 0 ? most : 1.0;
  return s;
}

Positions scatter(const Cloth& c, const Nodes& nodes) {
  Positions out(nodes.size());
  for (std::size_t p = 0; p < nodes.size(); ++p)
    for (const auto n : nodes[p]) out[p].push_back(c.at(static_cast<int>(n)));
  return out;
}

}  // namespace vitrine::sewing
