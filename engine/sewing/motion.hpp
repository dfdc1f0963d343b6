// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>

namespace vitrine::sewing {

// What a step of the relaxation does to all nodes alike. Vectors are packed, four numbers a node (springs.hpp); `nodes`
// is a multiple of four.

struct Sums {
  double force = 0;  ///< [N] sum of |f|
  double power = 0;  ///< [N m per step] f . v
  double vv = 0;     ///< twice the fictitious motion's energy
};
Sums sums_of(const double* f, const double* v, const double* mass, std::size_t nodes);

/// out = f / mass.
void scale_by_node(const double* f, const double* per_mass, std::size_t nodes, double* out);

/// a . a, weighted by the masses.
double squares_by_mass(const double* a, const double* mass, std::size_t nodes);

/// v = keep * v + push * a, number by number.
void steer(double keep, double push, const double* a, std::size_t count, double* v);

/// Moves by dt * v and adds the steps' lengths to `path`; gives the longest one.
double move(double dt, const double* v, std::size_t nodes, double* x, double* path);

/// Adds to each node's sum what its neighbours have in `v`.
void add_neighbours(const int* a, const int* b, std::size_t edges, const double* v, double* sum);

}  // namespace vitrine::sewing
