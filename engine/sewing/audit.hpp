// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cloth.hpp"
#include "vitrine/model/body.hpp"

namespace vitrine::sewing {

struct Strains {
  double p99 = 0, most = 0;  ///< [-] of |length / rest - 1| over all mesh edges
  double stretch_p99 = 0;  ///< [-] of length / rest - 1: folds squeeze a coarse mesh's edges, only stretch is a bad fit
};
Strains measure_strain(const Pattern& pattern, const Positions& positions);

/// Deepest node or middle of an edge or triangle inside the body surface [m]; 0 if none.
double measure_penetration(const Pattern& pattern, const Positions& positions, const DistanceField& body);

struct SelfContact {
  int close = 0;     ///< nodes closer than 1 mm to a triangle of the other panel, away from seams
  int crossed = 0;   ///< nodes that lie outside the other panel although they should lie within
  double depth = 0;  ///< [m] deepest crossing
};
/// Where front and back lie on or in each other. Sewing does not hold them apart; this tells whether it mattered.
SelfContact detect_self_contact(const Pattern& pattern, const Nodes& nodes, const Positions& positions);

}  // namespace vitrine::sewing
