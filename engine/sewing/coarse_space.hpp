// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "cloth.hpp"
#include "springs.hpp"

namespace vitrine::sewing {

/// Moves large pieces of a cloth as easily as single nodes: additive multilevel preconditioning (Bramble, Pasciak, Xu
/// 1990). On nested lattices in space, each twice as wide as the one before, a lattice point carries the cloth around
/// it by trilinear weights; its fictitious mass is the stiffness that such a move meets. With the nodes' masses alone
/// the softest modes, in which the whole garment swings, take as many steps as the mesh has nodes across.
class CoarseSpace {
 public:
  explicit CoarseSpace(const Cloth& cloth);
  bool empty() const { return levels_.empty(); }

  /// `held` nodes (1: pinned, or touching the body) do not take part: their own contact and friction decide. The
  /// points around them feel their `stiffness` [N/m] instead.
  void update(const std::vector<char>& held, const std::vector<double>& stiffness);

  /// Adds to `out` what `force` does through the lattices, [N] over [N/m].
  void apply(const Packed& force, const std::vector<char>& held, Packed& out);

 private:
  /// Rows of weights: of the cloth's nodes, or of the next finer lattice's points.
  struct Level {
    int count = 0;  ///< lattice points
    std::vector<int> first, column;
    std::vector<double> weight;
    std::vector<double> own, per_mass;  ///< per point: stiffness of the cloth alone [N/m]; [m/N]
    Packed force, move;
  };
  std::vector<Level> levels_;
};

}  // namespace vitrine::sewing
