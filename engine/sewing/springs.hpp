// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "cloth.hpp"

namespace vitrine::sewing {

/// Four numbers a node (x, y, z, 0), rounded up to whole groups of four nodes and one more group that no cloth uses.
using Packed = std::vector<double>;
std::size_t packed_nodes(int size);
void pack(const std::vector<double>& three, Packed& four);
void unpack(const Packed& four, std::vector<double>& three);

/// A cloth's forces as internal_forces() computes them, arranged for speed. Keeps no reference to the cloth.
class Springs {
 public:
  explicit Springs(const Cloth& cloth);
  /// Overwrites `force` [N] with springs, hinges, gravity and seams at x; returns the energy [J].
  double forces(const Packed& x, Packed& force) const;

 private:
  std::vector<int> ends_;              // per group of four edges: four starts, four ends, as places in a Packed
  std::vector<double> k_, rest_;       // per edge
  std::vector<double> buckles_;        // per edge: [m] of shortening
  std::vector<int> corners_;           // per hinge: four nodes, as places in a Packed
  std::vector<double> bend_, factor_;  // per hinge: [N/m], four coefficients
  std::vector<SeamSpring> seams_;
  Packed weight_;  // [N] per node, pointing down
};

}  // namespace vitrine::sewing
