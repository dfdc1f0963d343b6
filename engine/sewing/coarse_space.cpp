// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarse_space.hpp"

#include <algorithm>
#include <cmath>

#include "lanes.hpp"

namespace vitrine::sewing {
namespace {

constexpr double first_spacing = 2;  // [mesh edges]
constexpr double last_share = 0.75;  // no lattice wider than this share of the garment: it would move it as a block
constexpr double heavier = 1.5;      // moves of several lattices overlap; without this margin their sum overshoots
constexpr double most_cells = 4'000'000;  // a garment torn far apart gets wider lattices, not more memory

/// Places a point in a lattice: eight corners and their weights.
struct Lattice {
  Vec3 origin;
  double spacing = 1;
  int size[3] = {1, 1, 1};

  Lattice(const Vec3& lo, const Vec3& hi, double h) : origin(lo), spacing(h) {
    for (int a = 0; a < 3; ++a) size[a] = static_cast<int>(std::floor((hi[a] - lo[a]) / h)) + 2;
  }
  std::size_t cells() const { return static_cast<std::size_t>(size[0]) * size[1] * size[2]; }

  void corners(const Vec3& p, int* cell, double* weight) const {
    int at[3];
    double u[3];
    for (int a = 0; a < 3; ++a) {
      const double t = (p[a] - origin[a]) / spacing;
      at[a] = std::clamp(static_cast<int>(std::floor(t)), 0, size[a] - 2);
      u[a] = std::clamp(t - at[a], 0.0, 1.0);
    }
    for (int k = 0; k < 8; ++k) {
      const int x = k & 1, y = (k >> 1) & 1, z = k >> 2;
      cell[k] = ((at[2] + z) * size[1] + at[1] + y) * size[0] + at[0] + x;
      weight[k] = (x ? u[0] : 1 - u[0]) * (y ? u[1] : 1 - u[1]) * (z ? u[2] : 1 - u[2]);
    }
  }
  Vec3 place(int cell) const {
    return origin + spacing * Vec3(cell % size[0], cell / size[0] % size[1], cell / size[0] / size[1]);
  }
};

/// Sums differences of nodes in terms of lattice points, and how stiff the points are because of them.
class Majorant {
 public:
  Majorant(const std::vector<int>& column, const std::vector<double>& weight, int points, std::vector<double>& own)
      : column_(column), weight_(weight), sum_(points, 0.0), own_(own) {}

  void add(int node, double factor) {
    for (int k = 8 * node; k < 8 * node + 8; ++k) {
      if (weight_[k] == 0) continue;
      if (sum_[column_[k]] == 0) touched_.push_back(column_[k]);
      sum_[column_[k]] += factor * weight_[k];
    }
  }
  /// k |sum_j w_j u_j|^2 <= k (sum |w|) sum |w_j| |u_j|^2; a spring's row sums to 2k and counts as k, as for nodes.
  void close(double k) {
    double row = 0;
    for (const int c : touched_) row += std::abs(sum_[c]);
    for (const int c : touched_) {
      own_[c] += 0.5 * k * std::abs(sum_[c]) * row;
      sum_[c] = 0;
    }
    touched_.clear();
  }

 private:
  const std::vector<int>& column_;
  const std::vector<double>& weight_;
  std::vector<double> sum_;
  std::vector<int> touched_;
  std::vector<double>& own_;
};

/// Per row: force onto the columns.
VITRINE_WIDE void restrict_rows(const int* first, const int* column, const double* weight, int rows, const char* held,
                                const double* force, double* out) {
  for (int n = 0; n < rows; ++n) {
    if (held && held[n]) continue;
    const Four f = load(force + 4 * n);
    for (int e = first[n]; e < first[n + 1]; ++e) {
      double* o = out + 4 * column[e];
      store(o, load(o) + weight[e] * f);
    }
  }
}

VITRINE_WIDE void prolong_rows(const int* first, const int* column, const double* weight, int rows, const char* held,
                               const double* move, double* out) {
  for (int n = 0; n < rows; ++n) {
    if (held && held[n]) continue;
    Four sum = load(out + 4 * n);
    for (int e = first[n]; e < first[n + 1]; ++e) sum += weight[e] * load(move + 4 * column[e]);
    store(out + 4 * n, sum);
  }
}

VITRINE_WIDE void divide(const double* force, const double* per_mass, int count, double* move) {
  for (int j = 0; j < count; ++j) store(move + 4 * j, per_mass[j] * load(force + 4 * j));
}

double mean(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x;
  return v.empty() ? 0 : sum / static_cast<double>(v.size());
}

}  // namespace

CoarseSpace::CoarseSpace(const Cloth& c) {
  const double edge = mean(c.edge_rest);
  if (!(edge > 0)) return;
  Vec3 lo = c.at(0), hi = lo;
  std::vector<Vec3> nodes, points;
  for (int n = 0; n < c.size; ++n) nodes.push_back(c.at(n));
  for (const Vec3& p : nodes) lo = lo.cwiseMin(p), hi = hi.cwiseMax(p);
  const double widest = (hi - lo).maxCoeff();
  if (!std::isfinite(widest)) return;
  points = nodes;
  double h = first_spacing * edge;
  while (std::pow(widest / h, 3) > most_cells) h *= 2;
  std::vector<int> column(8 * nodes.size());
  std::vector<double> weight(8 * nodes.size());
  for (; h < last_share * widest; h *= 2) {
    const Lattice lattice(lo, hi, h);
    Level l;
    std::vector<int> number(lattice.cells(), -1);
    std::vector<Vec3> next;
    l.first.push_back(0);
    int cell[8];
    double w[8];
    for (const Vec3& p : points) {
      lattice.corners(p, cell, w);
      for (int k = 0; k < 8; ++k) {
        if (w[k] <= 1e-12) continue;
        if (number[cell[k]] < 0) {
          number[cell[k]] = l.count++;
          next.push_back(lattice.place(cell[k]));
        }
        l.column.push_back(number[cell[k]]);
        l.weight.push_back(w[k]);
      }
      l.first.push_back(static_cast<int>(l.column.size()));
    }
    // The lattices are nested, so a node's weights in a wider one are the products of those in between.
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      lattice.corners(nodes[n], cell, w);
      for (int k = 0; k < 8; ++k) {
        const bool used = w[k] > 1e-12 && number[cell[k]] >= 0;
        column[8 * n + k] = used ? number[cell[k]] : 0;
        weight[8 * n + k] = used ? w[k] : 0;
      }
    }
    l.own.assign(l.count, 0.0);
    Majorant majorant(column, weight, l.count, l.own);
    for (std::size_t e = 0; e < c.edge_k.size(); ++e) {
      majorant.add(c.edge_a[e], 1);
      majorant.add(c.edge_b[e], -1);
      majorant.close(c.edge_k[e]);
    }
    for (std::size_t e = 0; e < c.hinge_k.size(); ++e) {
      for (int j = 0; j < 4; ++j) majorant.add(c.hinge[4 * e + j], c.hinge_c[4 * e + j]);
      majorant.close(c.hinge_k[e]);
    }
    for (const SeamSpring& s : c.seams) {
      majorant.add(s.a, 1);
      majorant.add(s.b, -1);
      majorant.close(s.k);
    }
    l.per_mass.assign(l.count, 0.0);
    l.force.assign(4 * static_cast<std::size_t>(l.count), 0.0);
    l.move.assign(4 * static_cast<std::size_t>(l.count), 0.0);
    points = std::move(next);
    levels_.push_back(std::move(l));
  }
}

void CoarseSpace::update(const std::vector<char>& held, const std::vector<double>& stiffness) {
  std::vector<double> load(held.size());
  for (std::size_t n = 0; n < held.size(); ++n) load[n] = held[n] ? stiffness[n] : 0.0;
  for (Level& l : levels_) {
    std::vector<double> next(l.count, 0.0);
    for (std::size_t n = 0; n + 1 < l.first.size(); ++n)
      if (load[n] != 0)
        for (int e = l.first[n]; e < l.first[n + 1]; ++e) next[l.column[e]] += l.weight[e] * load[n];
    for (int j = 0; j < l.count; ++j) {
      const double mass = heavier * (l.own[j] + next[j]);
      l.per_mass[j] = mass > 0 ? 1 / mass : 0;
    }
    load = std::move(next);
  }
}

void CoarseSpace::apply(const Packed& force, const std::vector<char>& held, Packed& out) {
  const double* from = force.data();
  const char* skip = held.data();
  for (Level& l : levels_) {
    std::fill(l.force.begin(), l.force.end(), 0.0);
    restrict_rows(l.first.data(), l.column.data(), l.weight.data(), static_cast<int>(l.first.size()) - 1, skip, from,
                  l.force.data());
    divide(l.force.data(), l.per_mass.data(), l.count, l.move.data());
    from = l.force.data();
    skip = nullptr;
  }
  for (std::size_t i = levels_.size(); i-- > 0;) {
    const Level& l = levels_[i];
    prolong_rows(l.first.data(), l.column.data(), l.weight.data(), static_cast<int>(l.first.size()) - 1,
                 i == 0 ? held.data() : nullptr, l.move.data(), i == 0 ? out.data() : levels_[i - 1].move.data());
  }
}

}  // namespace vitrine::sewing
