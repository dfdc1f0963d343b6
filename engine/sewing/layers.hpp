// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "cloth.hpp"
#include "springs.hpp"

namespace vitrine::sewing {

/// A node of one panel beside a triangle of the other.
struct LayerPair {
  int node = 0, triangle[3] = {0, 0, 0};  ///< cloth nodes
  double share[3] = {0, 0, 0};            ///< [-] barycentric place of the node's foot on the triangle
  Vec3 outwards = Vec3::Zero();           ///< unit normal of the triangle, away from the wearer
  double height = 0;                      ///< [m] of the node over the triangle; above 0 it has passed through
  double hold = 1;                        ///< [-] 0 to 1: fades where the pair would leave the list
};

/// Every node of front and back with the nearest triangle of the other panel less than `reach` [m] away, in the order
/// of the nodes. Only walls that face away from each other count: a pleat that laps over a seam is in order. Nodes
/// within 4 cm of a sewn one, and at least two edges, are left out: next to a seam the panels always touch.
std::vector<LayerPair> find_layers(const Pattern& pattern, const Nodes& nodes, const Positions& positions,
                                   double reach);

/// Keeps front and back in their order where nothing of the body is between them, and draws them back through each
/// other where they have crossed: a node is pushed to the inner side of the other panel. Folds of one panel on itself
/// have no inner side and are not looked at.
class Layers {
 public:
  /// `k` [N/m] of the push per node.
  Layers(const Pattern& pattern, const Nodes& nodes, double k) : pattern_(pattern), nodes_(nodes), k_(k) {}

  /// Looks for the pairs anew; between two looks their normals and places stay, so that force and energy agree.
  void look(const Packed& x);
  /// Adds the pushes to `force`; gives their energy [J].
  double forces(const Packed& x, Packed& force) const;
  /// Adds their share to the fictitious masses.
  void add_stiffness(std::vector<double>& mass) const;

 private:
  const Pattern& pattern_;
  const Nodes& nodes_;
  double k_;
  std::vector<LayerPair> pairs_;
};

}  // namespace vitrine::sewing
