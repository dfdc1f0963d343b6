// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene.hpp"

#include <algorithm>
#include <cmath>

namespace vitrine::scene {
namespace {

double ellipsoid(const Vec3& p, const Vec3& c, const Vec3& r) {
  const Vec3 q = p - c;
  const double k = q.cwiseQuotient(r).norm(), k2 = q.cwiseQuotient(r.cwiseProduct(r)).norm();
  return k * (k - 1) / std::max(k2, 1e-9);
}

double capsule(const Vec3& p, const Vec3& a, const Vec3& b, double ra, double rb) {
  const Vec3 ab = b - a;
  const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (p - a - t * ab).norm() - (ra + (rb - ra) * t);
}

double body(const Vec3& p) {
  double d = ellipsoid(p, {0, 0.93, 0}, {0.17, 0.16, 0.115});
  auto join = [&](double e) {
    const double k = 0.03, h = std::clamp(0.5 + 0.5 * (e - d) / k, 0.0, 1.0);
    d = e + (d - e) * h - k * h * (1 - h);
  };
  join(ellipsoid(p, {0, 1.09, 0}, {0.145, 0.20, 0.10}));
  join(ellipsoid(p, {0, 1.25, 0.005}, {0.16, 0.19, 0.118}));
  join(ellipsoid(p, {0, 1.375, 0}, {0.195, 0.065, 0.07}));
  join(ellipsoid(p, {0, 1.42, -0.005}, {0.10, 0.045, 0.055}));
  join(capsule(p, {0, 1.40, 0}, {0, 1.53, 0.01}, 0.056, 0.052));
  join(ellipsoid(p, {0, 1.588, 0.015}, {0.075, 0.112, 0.092}));
  for (const double s : {-1.0, 1.0}) {
    join(capsule(p, {s * 0.085, 0.90, 0}, {s * 0.10, 0.45, 0}, 0.085, 0.055));
    join(capsule(p, {s * 0.10, 0.45, 0}, {s * 0.105, 0.05, 0}, 0.055, 0.04));
    const Vec3 shoulder(s * 0.17, 1.395, 0), down(s * 0.669, -0.743, 0);
    join(capsule(p, shoulder, shoulder + 0.26 * down, 0.05, 0.04));
    join(capsule(p, shoulder + 0.26 * down, shoulder + 0.56 * down, 0.04, 0.028));
  }
  return d;
}

Outline::Edge straight(const Vec2& a, const Vec2& b, int seam = -1) {
  return {a, a + (b - a) / 3, a + (b - a) * 2 / 3, b, seam};
}

/// Delaunay by point insertion (Bowyer-Watson); points arrive row by row, so the last triangle is a good start.
class Delaunay {
 public:
  explicit Delaunay(std::vector<Vec2> points) : p_(std::move(points)) {
    const int n = static_cast<int>(p_.size());
    p_.push_back({-1000, -1000});
    p_.push_back({1000, -1000});
    p_.push_back({0, 1000});
    t_.push_back({{n, n + 1, n + 2}, {-1, -1, -1}, true});
    std::vector<int> order(n);
    for (int i = 0; i < n; ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      const int ra = static_cast<int>(std::floor(p_[a].y() / 0.05)),
                rb = static_cast<int>(std::floor(p_[b].y() / 0.05));
      return ra != rb ? ra < rb : p_[a].x() != p_[b].x() ? p_[a].x() < p_[b].x() : a < b;
    });
    for (int i : order) insert(i);
  }

  std::vector<Triangle> triangles() const {
    const std::uint32_t n = static_cast<std::uint32_t>(p_.size()) - 3;
    std::vector<Triangle> out;
    for (const T& t : t_) {
      const Triangle q{static_cast<std::uint32_t>(t.v[0]), static_cast<std::uint32_t>(t.v[1]),
                       static_cast<std::uint32_t>(t.v[2])};
      if (t.alive && q[0] < n && q[1] < n && q[2] < n) out.push_back(q);
    }
    return out;
  }

 private:
  struct T {
    int v[3], next[3];  // next[i]: across the side from v[i] to v[i + 1]
    bool alive;
  };

  double turn(int a, int b, const Vec2& c) const {
    const Vec2 u = p_[b] - p_[a], w = c - p_[a];
    return u.x() * w.y() - u.y() * w.x();
  }
  bool in_circle(const T& t, const Vec2& d) const {
    const Vec2 a = p_[t.v[0]] - d, b = p_[t.v[1]] - d, c = p_[t.v[2]] - d;
    return a.squaredNorm() * (b.x() * c.y() - b.y() * c.x()) - b.squaredNorm() * (a.x() * c.y() - a.y() * c.x()) +
               c.squaredNorm() * (a.x() * b.y() - a.y() * b.x()) >
           1e-15;
  }

  void insert(int i) {
    const Vec2 q = p_[i];
    for (bool moved = true; moved;) {
      moved = false;
      for (int e = 0; e < 3 && !moved; ++e)
        if (turn(t_[last_].v[e], t_[last_].v[(e + 1) % 3], q) < -1e-15 && t_[last_].next[e] >= 0)
          last_ = t_[last_].next[e], moved = true;
    }
    std::vector<int> hole{last_};
    t_[last_].alive = false;
    struct Rim {
      int a, b, outside;
    };
    std::vector<Rim> rim;
    for (std::size_t h = 0; h < hole.size(); ++h)
      for (int e = 0; e < 3; ++e) {
        const int n = t_[hole[h]].next[e];
        if (n >= 0 && !t_[n].alive) continue;
        if (n >= 0 && in_circle(t_[n], q)) {
          t_[n].alive = false;
          hole.push_back(n);
        } else {
          rim.push_back({t_[hole[h]].v[e], t_[hole[h]].v[(e + 1) % 3], n});
        }
      }
    const int first = static_cast<int>(t_.size());
    // A side between two hole triangles may have been listed before the second one joined the hole.
    rim.erase(
        std::remove_if(rim.begin(), rim.end(), [&](const Rim& r) { return r.outside >= 0 && !t_[r.outside].alive; }),
        rim.end());
    for (const Rim& r : rim) {
      const int self = static_cast<int>(t_.size());
      t_.push_back({{r.a, r.b, i}, {r.outside, -1, -1}, true});
      if (r.outside >= 0)
        for (int e = 0; e < 3; ++e)
          if (t_[r.outside].v[e] == r.b && t_[r.outside].v[(e + 1) % 3] == r.a) t_[r.outside].next[e] = self;
    }
    for (std::size_t a = first; a < t_.size(); ++a)
      for (std::size_t b = first; b < t_.size(); ++b)
        if (t_[a].v[1] == t_[b].v[0]) t_[a].next[1] = static_cast<int>(b), t_[b].next[2] = static_cast<int>(a);
    last_ = first;
  }

  std::vector<Vec2> p_;
  std::vector<T> t_;
  int last_ = 0;
};

bool inside(const std::vector<Vec2>& poly, const Vec2& p) {
  bool in = false;
  for (std::size_t i = 0, j = poly.size() - 1; i < poly.size(); j = i++)
    if ((poly[i].y() > p.y()) != (poly[j].y() > p.y()) &&
        p.x() < (poly[j].x() - poly[i].x()) * (p.y() - poly[i].y()) / (poly[j].y() - poly[i].y()) + poly[i].x())
      in = !in;
  return in;
}

}  // namespace

DistanceField make_field(const Vec3& lo, const Vec3& hi, double spacing, const std::function<double(const Vec3&)>& f) {
  DistanceField d;
  d.origin = lo;
  d.spacing = spacing;
  for (int a = 0; a < 3; ++a) d.size[a] = static_cast<int>(std::ceil((hi[a] - lo[a]) / spacing)) + 1;
  for (int z = 0; z < d.size[2]; ++z)
    for (int y = 0; y < d.size[1]; ++y)
      for (int x = 0; x < d.size[0]; ++x) d.values.push_back(static_cast<float>(f(lo + spacing * Vec3(x, y, z))));
  return d;
}

const DistanceField& woman() {
  static const DistanceField field = make_field({-0.66, -0.06, -0.24}, {0.66, 1.78, 0.24}, 0.008, body);
  return field;
}

Outline vest() {
  const Vec2 hem(0.26, 0.85), armpit(0.235, 1.24), shoulder(0.17, 1.45), neck(0.085, 1.48);
  auto m = [](const Vec2& p) { return Vec2(-p.x(), p.y()); };
  Outline o;
  o.edges = {straight(m(hem), hem),
             straight(hem, armpit, 0),
             {armpit, {0.20, 1.255}, {0.16, 1.34}, shoulder, -1},
             straight(shoulder, neck, 1),
             {neck, {0.07, 1.375}, {-0.07, 1.375}, m(neck), -1},
             straight(m(neck), m(shoulder), 2),
             {m(shoulder), {-0.16, 1.34}, {-0.20, 1.255}, m(armpit), -1},
             straight(m(armpit), m(hem), 3)};
  return o;
}

Outline long_sleeve() {
  const Vec2 hem(0.25, 0.85), armpit(0.225, 1.20), low(0.457, 0.980), high(0.553, 1.066), shoulder(0.195, 1.45),
      neck(0.085, 1.485);
  auto m = [](const Vec2& p) { return Vec2(-p.x(), p.y()); };
  Outline o;
  o.edges = {straight(m(hem), hem),
             straight(hem, armpit, 0),
             straight(armpit, low, 1),
             straight(low, high),
             {high, {0.40, 1.23}, {0.27, 1.42}, shoulder, 2},
             straight(shoulder, neck, 3),
             {neck, {0.07, 1.40}, {-0.07, 1.40}, m(neck), -1},
             straight(m(neck), m(shoulder), 4),
             {m(shoulder), {-0.27, 1.42}, {-0.40, 1.23}, m(high), 5},
             straight(m(high), m(low)),
             straight(m(low), m(armpit), 6),
             straight(m(armpit), m(hem), 7)};
  return o;
}

Outline skirt(double w) {
  const Vec2 hem(0.36, 0.52), waist(0.5 * w, 1.06);
  auto m = [](const Vec2& p) { return Vec2(-p.x(), p.y()); };
  Outline o;
  o.edges = {straight(m(hem), hem),
             {hem, {0.30, 0.70}, {0.25, 0.93}, waist, 0},
             straight(waist, m(waist)),
             {m(waist), {-0.25, 0.93}, {-0.30, 0.70}, m(hem), 1}};
  return o;
}

Outline trousers() {
  const Vec2 waist(0.19, 1.05), outer(0.19, 0.25), inner(0.04, 0.25), crotch(0, 0.74);
  auto m = [](const Vec2& p) { return Vec2(-p.x(), p.y()); };
  Outline o;
  o.edges = {straight(m(outer), m(inner)),
             straight(m(inner), crotch, 0),
             straight(crotch, inner, 1),
             straight(inner, outer),
             {outer, {0.23, 0.60}, {0.26, 0.92}, waist, 2},
             straight(waist, m(waist)),
             {m(waist), {-0.26, 0.92}, {-0.23, 0.60}, m(outer), 3}};
  return o;
}

Pattern make_pattern(const Outline& outline, double h) {
  Panel panel;
  std::vector<std::vector<int>> sewn(outline.edges.size());
  for (std::size_t e = 0; e < outline.edges.size(); ++e) {
    const auto& b = outline.edges[e];
    std::vector<Vec2> fine;
    for (int i = 0; i <= 200; ++i) {
      const double t = i / 200.0, s = 1 - t;
      fine.push_back(s * s * s * b.from + 3 * s * s * t * b.bend_a + 3 * s * t * t * b.bend_b + t * t * t * b.to);
    }
    std::vector<double> along(1, 0.0);
    for (int i = 1; i <= 200; ++i) along.push_back(along.back() + (fine[i] - fine[i - 1]).norm());
    const int n = std::max(2, static_cast<int>(std::lround(along.back() / h)));
    for (int i = 0; i < n; ++i) {
      const double want = along.back() * i / n;
      const int at = static_cast<int>(std::upper_bound(along.begin(), along.end(), want) - along.begin()) - 1;
      const int k = std::min(at, 199);
      sewn[e].push_back(static_cast<int>(panel.outline.size()));
      panel.outline.push_back(fine[k] + (fine[k + 1] - fine[k]) * ((want - along[k]) / (along[k + 1] - along[k])));
    }
    sewn[e].push_back(static_cast<int>(panel.outline.size()));
  }
  const int border = static_cast<int>(panel.outline.size());
  PanelMesh mesh;
  mesh.nodes = panel.outline;
  Vec2 lo = mesh.nodes[0], hi = lo;
  for (const Vec2& p : mesh.nodes) lo = lo.cwiseMin(p), hi = hi.cwiseMax(p);
  const double row = h * std::sqrt(0.75);
  int j = 0;
  for (double y = lo.y() + row; y < hi.y(); y += row, ++j) {
    const int half = static_cast<int>(std::ceil((hi.x() - lo.x()) / h));
    for (int i = -half; i <= half; ++i) {
      const Vec2 p((i + (j % 2 ? 0.5 : 0.0)) * h, y);
      double near = 1e9;
      for (int k = 0; k < border; ++k) near = std::min(near, (panel.outline[k] - p).norm());
      if (near > 0.62 * h && inside(panel.outline, p)) mesh.nodes.push_back(p);
    }
  }
  // A jitter far below any length that matters breaks the ties of the regular grid.
  std::vector<Vec2> jittered = mesh.nodes;
  unsigned seed = 1;
  for (Vec2& p : jittered)
    for (int a = 0; a < 2; ++a) {
      seed = seed * 1664525u + 1013904223u;
      p[a] += 1e-4 * h * (static_cast<double>(seed >> 8) / (1 << 24) - 0.5);
    }
  for (Triangle t : Delaunay(jittered).triangles()) {
    const Vec2 a = mesh.nodes[t[0]], b = mesh.nodes[t[1]], c = mesh.nodes[t[2]];
    const double area = 0.5 * ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
    if (!inside(panel.outline, (a + b + c) / 3) || std::abs(area) < 1e-3 * h * h) continue;
    if (area < 0) std::swap(t[1], t[2]);
    mesh.triangles.push_back(t);
  }
  Pattern out;
  out.edge_length = h;
  out.panels = {panel, panel};
  out.panels[1].side = Side::back;
  out.meshes = {mesh, mesh};
  for (std::size_t e = 0; e < outline.edges.size(); ++e)
    if (outline.edges[e].seam >= 0)
      for (int n : sewn[e]) out.pairs.push_back({0, n % border, 1, n % border, outline.edges[e].seam});
  return out;
}

std::vector<std::vector<Vec3>> place_flat(const Pattern& pattern, double gap, double up) {
  std::vector<std::vector<Vec3>> out(2);
  for (int p = 0; p < 2; ++p)
    for (const Vec2& q : pattern.meshes[p].nodes) out[p].push_back({q.x(), q.y() + up, p == 0 ? gap : -gap});
  return out;
}

PanelMesh grid_mesh(double width, double height, int columns, int rows, const Vec2& lower_left) {
  PanelMesh m;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) m.nodes.push_back(lower_left + Vec2(width * i / columns, height * j / rows));
  auto id = [&](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const bool rising = (2 * i < columns) == (j % 2 == 0);
      if (rising) {
        m.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
        m.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
      } else {
        m.triangles.push_back({id(i, j), id(i + 1, j), id(i, j + 1)});
        m.triangles.push_back({id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
      }
    }
  return m;
}

Fabric cotton() {
  Fabric f;
  f.name = "cotton";
  f.stretch = 1000;
  f.shear = 300;
  f.bend = 1e-5;
  f.mass = 0.2;
  f.friction = 0.3;
  return f;
}

}  // namespace vitrine::scene
