// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "vitrine/model/garment_template.hpp"
#include "vitrine/model/panel.hpp"

namespace vitrine::sewing {

using Nodes = std::vector<std::vector<std::uint32_t>>;  ///< per panel, per mesh node: index of the cloth's node
using Positions = std::vector<std::vector<Vec3>>;       ///< per panel, per mesh node [m]

/// A seam that has not met yet: pulls two cloth nodes together, at most with `cap` newtons.
struct SeamSpring {
  int a = 0, b = 0;
  double k = 0;    ///< [N/m]
  double cap = 0;  ///< [N]
};

/// What the material constants are once spread over a mesh.
struct SheetStiffness {
  double stretch = 0, shear = 0;  ///< [N/m]
  double bend = 0;                ///< [N m]
};

/// The mass-spring system of paper III.C in arrays that the relaxation streams through. Sewn nodes are one node here.
struct Cloth {
  int size = 0;
  std::vector<double> x;     ///< [m] 3 per node
  std::vector<double> mass;  ///< [kg]
  std::vector<double> area;  ///< [m^2] of cloth at the node
  std::vector<char> pinned;  ///< 1: never moves (used by the tests' analytic scenes)
  std::vector<double> side;  ///< +1 front, -1 back, 0 where both meet

  std::vector<int> edge_a, edge_b;
  std::vector<double> edge_k, edge_rest;
  std::vector<double> edge_buckles;  ///< [m] the shortening at which an edge buckles; empty: none ever does

  std::vector<int> hinge;                ///< 4 nodes per hinge: edge start, edge end, two opposite corners
  std::vector<double> hinge_k, hinge_c;  ///< [N/m], 4 coefficients [-] per hinge

  std::vector<SeamSpring> seams;
  std::vector<std::array<int, 3>> triangles;

  double gravity = 0;  ///< [m/s^2]
  double weight = 0;   ///< [N] of all free nodes at the garment's own gravity, 0 if weightless
  double scale = 0;    ///< [N] what residuals are divided by: the weight, or a small share of the spring forces

  Vec3 at(int i) const { return {x[3 * i], x[3 * i + 1], x[3 * i + 2]}; }
};

/// Mean length [m] of the edges of both panels' triangles at rest, at least 0.1 mm.
double mean_edge(const Pattern& pattern);

/// Which mesh nodes are one node: union-find over the pairs, so a corner that belongs to several seams welds once.
/// `weld[p]` tells whether pairs[p] is sewn. Node numbers follow the mesh from neighbour to neighbour, which keeps the
/// springs of a node close together in memory.
Nodes number_nodes(const Pattern& pattern, std::span<const char> weld, int& count);

/// Springs, hinges and masses of the pattern. Sheet stiffness K becomes k = K * A / L^2 per edge (A: area of the
/// triangles at the edge), so that a finer mesh is the same fabric; on an equilateral mesh Young's modulus is K itself.
/// Bending: quadratic isometric hinges (Bergou et al. 2006), also across welded seams; ten times as stiff within 2 cm
/// of an open edge of a panel's outline, where cloth is hemmed or bound. With bending, an edge that is pressed together
/// buckles as its strip of cloth would, at Euler's load pi^2 B (A/L) / L^2, and gives way from there on: the folds that
/// are too small for the mesh (Choi & Ko 2002, "Stable but responsive cloth").
Cloth build_cloth(const Pattern& pattern, const Nodes& nodes, int count, const Positions& start,
                  const SheetStiffness& sheet, double density, double gravity, bool bending);

constexpr double tiny_length = 1e-9;  ///< [m] below this a direction means nothing
/// Share [-] of its stiffness that an edge keeps past the point where it buckles: a little, so that the mesh keeps its
/// shape.
constexpr double buckled_share = 0.1;

/// Gives every spring the stiffness `k` [N/m] and every node the mass `m` [kg], as in the paper's eq. (2); 0 leaves
/// what build_cloth() spread. The paper's springs are the same both ways: none buckles.
void set_raw_constants(Cloth& cloth, double k, double m);

/// Adds the forces of springs, hinges, gravity and seams [N] to `force` (3 per node) and returns the energy [J].
double internal_forces(const Cloth& cloth, const std::vector<double>& x, std::vector<double>& force);

/// Per node an upper bound of the stiffness it feels [N/m]: the fictitious mass of the relaxation.
std::vector<double> node_stiffness(const Cloth& cloth);

/// Positions per panel and mesh node.
Positions scatter(const Cloth& cloth, const Nodes& nodes);

}  // namespace vitrine::sewing
