// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "cloth.hpp"
#include "contact.hpp"

namespace vitrine::sewing {

struct Closing {
  std::vector<char> met;  ///< per pair: 1 when the partners met, now or before
  double gap_met = 0;     ///< [m] largest distance of partners that met, just before welding
  double gap_open = 0;    ///< [m] largest distance of partners that did not
  int open = 0;           ///< pairs that did not meet
  int iterations = 0;
  bool finite = true;
  double k = 0, cap = 0;  ///< the seam springs' last stiffness [N/m] and force limit [N]
};

/// Draws the partners of all pairs that are not welded together (paper III.C: the attractive force) with gravity off,
/// until each pair is closer than `meet` [m]. Moves the cloth.
Closing close_seams(Cloth& cloth, Contact& contact, const Pattern& pattern, const Nodes& nodes,
                    const std::vector<char>& weld, double sheet_k, double edge_length, double meet);

/// Seam springs for the pairs that are not welded.
std::vector<SeamSpring> springs_for(const Pattern& pattern, const Nodes& nodes, const std::vector<char>& weld, double k,
                                    double cap);

/// Distance of the partners [m], per pair.
std::vector<double> gaps(const Pattern& pattern, const Positions& positions);

}  // namespace vitrine::sewing
