// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact.hpp"

#include <algorithm>
#include <cmath>

#include "smooth_field.hpp"

namespace vitrine::sewing {
namespace {

constexpr double lipschitz = 1.2;     // trilinear interpolation of a distance may be a little steeper than 1
constexpr double middle_share = 0.5;  // middles of edges may sink to half the offset: chords cut curves, cloth does not

constexpr double sag_that_matters = 0.375;  // of the offset: with a margin for the way the cloth still has to go
constexpr double limb_turn = 1;             // [rad] along an edge
// All samples are called every so many steps of the present length; those further away sleep until then.
constexpr double steps_asleep = 30, shortest_nap = 5e-5, longest_nap = 3e-3;  // [m]
constexpr double plane_reach = 2e-4;  // [m] around a look, where the field passes for a plane

inline Vec3 where(const ContactSample& s, const Packed& x) {
  const double* a = &x[4 * s.node[0]];
  if (s.count == 1) return {a[0], a[1], a[2]};
  Vec3 p = Vec3::Zero();
  for (int j = 0; j < s.count; ++j)
    p += s.share[j] * Vec3(x[4 * s.node[j]], x[4 * s.node[j] + 1], x[4 * s.node[j] + 2]);
  return p;
}

double path_of(const ContactSample& s, const std::vector<double>& path) {
  if (s.count == 1) return path[s.node[0]];
  double sum = 0;
  for (int j = 0; j < s.count; ++j) sum += s.share[j] * path[s.node[j]];
  return sum;
}

void call_all(Contact& c) {
  const double step = c.travelled - c.travelled_before;
  c.call_all = c.travelled + std::clamp(steps_asleep * step, shortest_nap, longest_nap);
  c.awake.clear();
  for (std::size_t i = 0; i < c.samples.size(); ++i)
    if (c.asleep_until[i] <= c.call_all) c.awake.push_back(static_cast<int>(i));
}

void look(const DistanceField& field, ContactSample& s, const Vec3& p) {
  s.known = true;
  s.seen = p;
  s.seen_gap = smooth_distance(field, p, s.slope) - s.limit;
  // The gradient as it is, so that force and energy agree; only where the field is flat (its ridges, deep inside) does
  // the push keep a useful strength.
  const double steep = std::max(s.slope.norm(), 1e-9);
  if (s.seen_gap < 0 && steep < 0.3) s.slope *= 0.3 / steep;
}

/// Whether a sample is too far from the body to feel it soon.
bool far_away(const Contact& c, std::size_t i, const Packed& x) {
  const ContactSample& s = c.samples[i];
  const double far = 0.2 * c.offset, sleeps = lipschitz * (c.asleep_until[i] - c.travelled);
  if (sleeps > far) return true;
  return (s.known && sleeps <= 0 ? s.gap : c.field->distance(where(s, x)) - s.limit) > far;
}

/// Unit ways out of the body at the cloth's nodes.
std::vector<Vec3> ways_out_of_body(const Cloth& cloth, const DistanceField& field) {
  std::vector<Vec3> way(cloth.size);
  for (int n = 0; n < cloth.size; ++n) {
    field.distance(cloth.at(n), way[n]);
    way[n] /= std::max(way[n].norm(), 1e-9);
  }
  return way;
}

/// Samples between the nodes: of every edge and triangle, or of those the body curves under. `s` is an ordinary node's.
void add_middles(Contact& c, const Cloth& cloth, ContactSample s) {
  const bool all = c.middles == Middles::all;
  const std::vector<Vec3> way = ways_out_of_body(cloth, *c.field);
  // A chord over which the surface turns by an angle sags by length * angle / 8.
  const auto turn = [&](int a, int b) { return std::acos(std::clamp(way[a].dot(way[b]), -1.0, 1.0)); };
  const auto bridges = [&](int a, int b) {
    return all || (cloth.at(a) - cloth.at(b)).norm() * turn(a, b) / 8 > sag_that_matters * c.offset;
  };
  s.limit = middle_share * c.offset;
  s.count = 2;
  for (std::size_t e = 0; e < cloth.edge_k.size(); ++e) {
    const int a = s.node[0] = cloth.edge_a[e], b = s.node[1] = cloth.edge_b[e];
    if (!bridges(a, b)) continue;
    // Long edges are looked at in three places where they lie on a limb, which may be as thin as they are long.
    const bool is_long = cloth.edge_rest[e] > 6 * c.field->spacing;
    const int places = is_long && (all || turn(a, b) > limb_turn) ? 3 : 1;
    for (int i = 1; i <= places; ++i) {
      s.share[1] = static_cast<double>(i) / (places + 1);
      s.share[0] = 1 - s.share[1];
      c.samples.push_back(s);
    }
  }
  s.count = 3;
  std::fill(s.share, s.share + 3, 1.0 / 3);
  for (const auto& t : cloth.triangles) {
    if (!bridges(t[0], t[1]) && !bridges(t[1], t[2]) && !bridges(t[2], t[0])) continue;
    std::copy(t.begin(), t.end(), s.node);
    c.samples.push_back(s);
  }
}

}  // namespace

Contact make_contact(const Cloth& cloth, const DistanceField& field, double offset, double load, double sheet_k,
                     Middles middles) {
  Contact c;
  c.field = &field;
  c.offset = offset;
  c.normal.assign(4 * packed_nodes(cloth.size), 0.0);
  const double k = std::max(0.3 * sheet_k, load / (0.05 * offset));
  c.k_most = 64 * k;
  ContactSample s;
  s.k = k;
  s.limit = offset;
  for (int n = 0; n < cloth.size; ++n) {
    s.node[0] = n;
    c.samples.push_back(s);
  }
  c.middles = middles;
  add_middles(c, cloth, s);
  c.asleep_until.assign(c.samples.size(), 0.0);
  return c;
}

double contact_forces(Contact& c, const Packed& x, const std::vector<double>& path, Packed& force, bool exact) {
  for (const int n : c.touched) std::fill_n(&c.normal[4 * n], 4, 0.0);
  c.touched.clear();
  if (c.travelled >= c.call_all) call_all(c);
  c.travelled_before = c.travelled;
  double energy = 0;
  for (const int i : c.awake) {
    if (c.asleep_until[i] > c.travelled) continue;
    ContactSample& s = c.samples[i];
    const double travelled = path_of(s, path);
    if (s.known && s.gap > 0) {
      const double left = s.gap / lipschitz - (travelled - s.seen_path);
      if (left > 0) {
        c.asleep_until[i] = c.travelled + left;
        continue;
      }
    }
    const Vec3 p = where(s, x);
    const Vec3 moved = p - s.seen;
    if (exact || !s.known || moved.squaredNorm() > plane_reach * plane_reach) {
      look(*c.field, s, p);
      s.gap = s.seen_gap;
    } else {
      s.gap = s.seen_gap + s.slope.dot(moved);
    }
    s.seen_path = travelled;
    if (s.gap >= 0) {
      c.asleep_until[i] = c.travelled + s.gap / lipschitz;
      continue;
    }
    // Deep inside, the push stays that of the offset's own depth: a spring over centimetres would tear the cloth.
    const double depth = std::min(-s.gap, 2 * c.offset);
    energy += s.k * depth * (-s.gap - 0.5 * depth);
    const Vec3 push = s.slope * (s.k * depth);
    for (int j = 0; j < s.count; ++j) {
      const int n = s.node[j];
      double* normal = &c.normal[4 * n];
      if (normal[3] == 0) {
        normal[3] = 1;  // the unused fourth number marks a node that is on the list
        c.touched.push_back(n);
      }
      for (int a = 0; a < 3; ++a) {
        force[4 * n + a] += s.share[j] * push[a];
        normal[a] += s.share[j] * push[a];
      }
    }
  }
  return energy;
}

void wake(Contact& c) {
  for (ContactSample& s : c.samples) s.known = false;
  std::fill(c.asleep_until.begin(), c.asleep_until.end(), 0.0);
  c.travelled = c.travelled_before = c.call_all = 0;
}

void strengthen(Contact& c, double load) {
  const double k = load / (0.5 * c.offset);
  c.k_most = std::max(c.k_most, k);
  for (ContactSample& s : c.samples) s.k = std::max(s.k, k);
}

bool refresh_contact(Contact& c) {
  bool raised = false;
  for (const int i : c.awake) {
    ContactSample& s = c.samples[i];
    if (!s.known || -s.gap < 0.05 * c.offset || s.k >= c.k_most) continue;
    s.k = std::min(2 * s.k, c.k_most);
    raised = true;
  }
  return raised;
}

void add_contact_stiffness(const Contact& c, const Packed& x, std::vector<double>& mass) {
  for (std::size_t i = 0; i < c.samples.size(); ++i) {
    const ContactSample& s = c.samples[i];
    // Nodes always carry their penalty, so that touching down changes no mass; middles rarely touch.
    if (s.count > 1 && far_away(c, i, x)) continue;
    for (int j = 0; j < s.count; ++j) mass[s.node[j]] += s.k * s.share[j];
  }
}

int push_out(Cloth& cloth, const DistanceField& field, double offset) {
  int deep = 0;
  for (int n = 0; n < cloth.size; ++n) {
    Vec3 p = cloth.at(n), gradient;
    double d = field.distance(p, gradient);
    if (d >= offset || cloth.pinned[n]) continue;
    const double side = cloth.side[n];
    if (d < -0.01) ++deep;
    for (int step = 0; step < 200 && d < offset; ++step) {
      const double steep = gradient.norm();
      Vec3 way = steep > 1e-6 ? Vec3(gradient / steep) : Vec3(0, 0, side >= 0 ? 1 : -1);
      if (d < 0 && side != 0 && way.z() * side < 0) way = Vec3(0, 0, side);
      p += way * std::max(0.5 * field.spacing, std::min(0.02, offset - d));
      d = field.distance(p, gradient);
    }
    for (int a = 0; a < 3; ++a) cloth.x[3 * n + a] = p[a];
  }
  return deep;
}

}  // namespace vitrine::sewing
