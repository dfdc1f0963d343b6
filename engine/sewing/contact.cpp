// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact.hpp"

#include <algorithm>
#include <cmath>

#include "smooth_field.hpp"

namespace vitrine::sewing {
namespace {

constexpr double lipschitz = 1.2;     // trilinear interpolation of a distance may be a little steeper than 1
constexpr double middle_share = 0.5;  // middles of edges may sink to half the offset: chords cut curves, cloth does not

Vec3 where(const ContactSample& s, const std::vector<double>& x) {
  const double* a = &x[3 * s.node[0]];
  if (s.count == 1) return {a[0], a[1], a[2]};
  Vec3 p = Vec3::Zero();
  for (int j = 0; j < s.count; ++j)
    p += s.share[j] * Vec3(x[3 * s.node[j]], x[3 * s.node[j] + 1], x[3 * s.node[j] + 2]);
  return p;
}

double travelled(const ContactSample& s, const std::vector<double>& path) {
  double sum = 0;
  for (int j = 0; j < s.count; ++j) sum += s.share[j] * path[s.node[j]];
  return sum;
}

}  // namespace

Contact make_contact(const Cloth& cloth, const DistanceField& field, double offset, double edge_length, double load,
                     double sheet_k) {
  Contact c;
  c.field = &field;
  c.offset = offset;
  c.path.assign(cloth.size, 0.0);
  c.normal.assign(3 * static_cast<std::size_t>(cloth.size), 0.0);
  const double k = std::max(0.3 * sheet_k, load / (0.05 * offset));
  c.k_most = 64 * k;
  ContactSample s;
  s.k = k;
  s.limit = offset;
  for (int n = 0; n < cloth.size; ++n) {
    s.node[0] = n;
    c.samples.push_back(s);
  }
  if (edge_length > 2 * field.spacing) {
    s.limit = middle_share * offset;
    s.count = 2;
    // Long edges are looked at in three places: a wrist is as thin as they are long.
    const int places = edge_length > 6 * field.spacing ? 3 : 1;
    for (std::size_t e = 0; e < cloth.edge_k.size(); ++e)
      for (int i = 1; i <= places; ++i) {
        s.node[0] = cloth.edge_a[e];
        s.node[1] = cloth.edge_b[e];
        s.share[1] = static_cast<double>(i) / (places + 1);
        s.share[0] = 1 - s.share[1];
        c.samples.push_back(s);
      }
    s.count = 3;
    std::fill(s.share, s.share + 3, 1.0 / 3);
    for (const auto& t : cloth.triangles) {
      std::copy(t.begin(), t.end(), s.node);
      c.samples.push_back(s);
    }
  }
  return c;
}

double contact_forces(Contact& c, const std::vector<double>& x, std::vector<double>& force, bool fresh) {
  std::fill(c.normal.begin(), c.normal.end(), 0.0);
  double energy = 0;
  for (ContactSample& s : c.samples) {
    if (!fresh && s.gap > lipschitz * (travelled(s, c.path) - s.travelled)) continue;
    Vec3 gradient;
    s.gap = smooth_distance(*c.field, where(s, x), gradient) - s.limit;
    s.travelled = travelled(s, c.path);
    if (s.gap >= 0) continue;
    // The gradient as it is, so that force and energy agree; only where the field is flat (its ridges, deep inside)
    // does the push keep a useful strength.
    const double steep = std::max(gradient.norm(), 1e-9);
    if (steep < 0.3) gradient *= 0.3 / steep;
    // Deep inside, the push stays that of the offset's own depth: a spring over centimetres would tear the cloth.
    const double depth = std::min(-s.gap, 2 * c.offset);
    energy += s.k * depth * (-s.gap - 0.5 * depth);
    const Vec3 push = gradient * (s.k * depth);
    for (int j = 0; j < s.count; ++j)
      for (int a = 0; a < 3; ++a) {
        force[3 * s.node[j] + a] += s.share[j] * push[a];
        c.normal[3 * s.node[j] + a] += s.share[j] * push[a];
      }
  }
  return energy;
}

void strengthen(Contact& c, double load) {
  const double k = load / (0.5 * c.offset);
  c.k_most = std::max(c.k_most, k);
  for (ContactSample& s : c.samples) s.k = std::max(s.k, k);
}

bool refresh_contact(Contact& c, const std::vector<double>& x) {
  bool raised = false;
  for (ContactSample& s : c.samples) {
    if (s.gap >= 0 || s.k >= c.k_most) continue;
    Vec3 gradient;
    if (s.limit - smooth_distance(*c.field, where(s, x), gradient) < 0.05 * c.offset) continue;
    s.k = std::min(2 * s.k, c.k_most);
    raised = true;
  }
  return raised;
}

void add_contact_stiffness(const Contact& c, const std::vector<double>& x, std::vector<double>& mass) {
  for (const ContactSample& s : c.samples) {
    // Nodes always carry their penalty, so that touching down changes no mass; middles rarely touch.
    if (s.count > 1 && c.field->distance(where(s, x)) > s.limit + 0.2 * c.offset) continue;
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
