// SPDX-License-Identifier: GPL-3.0-or-later
#include "springs.hpp"

#include <algorithm>
#include <cmath>

#include "lanes.hpp"

namespace vitrine::sewing {
namespace {

constexpr double never = 1e9;  // [m] more than any edge can shorten

VITRINE_WIDE double hang(const double* weight, const double* x, std::size_t count, double* force) {
  Four energy = {};
  for (std::size_t i = 0; i < count; i += 4) {
    const Four w = load(weight + i);
    store(force + i, w);
    energy -= w * load(x + i);
  }
  return sum(energy);
}

/// Adds a force to one end of a spring and takes it from the other.
VITRINE_INLINE void pull(double* force, int a, int b, const Four& f) {
  store(force + a, load(force + a) + f);
  store(force + b, load(force + b) - f);
}

VITRINE_WIDE double stretch(const int* ends, const double* k, const double* rest, const double* buckles,
                            std::size_t groups, const double* x, double* force) {
  Four energy = {};
  const Four one = {1, 1, 1, 1}, none = {};
  for (std::size_t g = 0; g < groups; ++g) {
    const int* n = ends + 8 * g;
    const Four d0 = load(x + n[4]) - load(x + n[0]), d1 = load(x + n[5]) - load(x + n[1]);
    const Four d2 = load(x + n[6]) - load(x + n[2]), d3 = load(x + n[7]) - load(x + n[3]);
    const Four length = root(squares(d0, d1, d2, d3));
    const Four longer = length - load(rest + 4 * g), past = longer + load(buckles + 4 * g), strength = load(k + 4 * g);
    const Four buckled = past < 0 ? past : none;
    const Four tension = strength * (longer - (1 - buckled_share) * buckled);
    energy += strength * (longer * longer - (1 - buckled_share) * (buckled * buckled));
    // Without a direction there is no force: the neighbours will pull it apart.
    const Four s = length < tiny_length ? none : tension / (length < tiny_length ? one : length);
    pull(force, n[0], n[4], s[0] * d0);
    pull(force, n[1], n[5], s[1] * d1);
    pull(force, n[2], n[6], s[2] * d2);
    pull(force, n[3], n[7], s[3] * d3);
  }
  return 0.5 * sum(energy);
}

VITRINE_WIDE double bend(const int* corners, const double* k, const double* factor, std::size_t count, const double* x,
                         double* force) {
  Four energy = {};
  for (std::size_t h = 0; h < count; ++h) {
    const int* n = corners + 4 * h;
    const double* c = factor + 4 * h;
    const Four v = c[0] * load(x + n[0]) + c[1] * load(x + n[1]) + c[2] * load(x + n[2]) + c[3] * load(x + n[3]);
    const Four f = k[h] * v;
    energy += f * v;
    for (int j = 0; j < 4; ++j) store(force + n[j], load(force + n[j]) - c[j] * f);
  }
  return 0.5 * sum(energy);
}

}  // namespace

std::size_t packed_nodes(int size) {
  return (static_cast<std::size_t>(size) + 3) / 4 * 4 + 4;
}

void pack(const std::vector<double>& three, Packed& four) {
  const std::size_t count = three.size() / 3;
  four.assign(4 * packed_nodes(static_cast<int>(count)), 0.0);
  for (std::size_t n = 0; n < count; ++n) std::copy_n(&three[3 * n], 3, &four[4 * n]);
}

void unpack(const Packed& four, std::vector<double>& three) {
  for (std::size_t n = 0; n < three.size() / 3; ++n) std::copy_n(&four[4 * n], 3, &three[3 * n]);
}

Springs::Springs(const Cloth& c)
    : k_(c.edge_k),
      rest_(c.edge_rest),
      buckles_(c.edge_buckles),
      bend_(c.hinge_k),
      factor_(c.hinge_c),
      seams_(c.seams) {
  const int unused = 4 * static_cast<int>(packed_nodes(c.size) - 1);
  while (k_.size() % 4 != 0) k_.push_back(0), rest_.push_back(0);
  buckles_.resize(k_.size(), never);
  ends_.assign(2 * k_.size(), unused);
  for (std::size_t e = 0; e < c.edge_k.size(); ++e) {
    ends_[e / 4 * 8 + e % 4] = 4 * c.edge_a[e];
    ends_[e / 4 * 8 + 4 + e % 4] = 4 * c.edge_b[e];
  }
  for (const int n : c.hinge) corners_.push_back(4 * n);
  weight_.assign(4 * packed_nodes(c.size), 0.0);
  for (int n = 0; n < c.size; ++n) weight_[4 * n + 1] = -c.mass[n] * c.gravity;
}

double Springs::forces(const Packed& x, Packed& force) const {
  double energy = hang(weight_.data(), x.data(), weight_.size(), force.data());
  energy += stretch(ends_.data(), k_.data(), rest_.data(), buckles_.data(), k_.size() / 4, x.data(), force.data());
  energy += bend(corners_.data(), bend_.data(), factor_.data(), bend_.size(), x.data(), force.data());
  for (const SeamSpring& s : seams_) {
    double d[3], gap = 0;
    for (int a = 0; a < 3; ++a) d[a] = x[4 * s.b + a] - x[4 * s.a + a], gap += d[a] * d[a];
    gap = std::sqrt(gap);
    const double reach = s.k > 0 ? s.cap / s.k : 0;
    energy += gap <= reach ? 0.5 * s.k * gap * gap : s.cap * (gap - 0.5 * reach);
    const double strength = gap <= reach ? s.k : s.cap / std::max(gap, tiny_length);
    for (int a = 0; a < 3; ++a) force[4 * s.a + a] += strength * d[a], force[4 * s.b + a] -= strength * d[a];
  }
  return energy;
}

}  // namespace vitrine::sewing
