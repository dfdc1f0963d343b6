// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <vector>

#include "vitrine/model/body.hpp"
#include "vitrine/model/garment_template.hpp"
#include "vitrine/model/panel.hpp"

namespace vitrine::scene {

constexpr double g = 9.81;  ///< [m/s^2]

/// A distance field filled from a formula.
DistanceField make_field(const Vec3& lo, const Vec3& hi, double spacing, const std::function<double(const Vec3&)>& f);

/// A woman of ellipsoids and capsules, 1.70 m, arms 42 degrees from vertical.
const DistanceField& woman();

/// Outline of a garment: corners joined by straight or curved edges; edges with seam >= 0 are sewn front to back.
struct Outline {
  struct Edge {
    Vec2 from, bend_a, bend_b, to;  ///< cubic Bezier
    int seam = -1;
  };
  std::vector<Edge> edges;  ///< counter-clockwise, closed
};
Outline vest();
Outline long_sleeve();
Outline skirt(double waist_half_width = 0.375);
/// Two legs that meet in a crotch, where four sewn edges come together.
Outline trousers();

/// Front and back from the same outline, meshed by Delaunay at the edge length; both panels share nodes and numbers.
Pattern make_pattern(const Outline& outline, double edge_length);

/// Every node at its pattern place, front at z = +gap, back at z = -gap, lifted by `up`.
std::vector<std::vector<Vec3>> place_flat(const Pattern& pattern, double gap, double up = 0);

/// Rectangle of columns x rows cells; diagonals alternate, mirror-symmetric about its middle column line.
PanelMesh grid_mesh(double width, double height, int columns, int rows, const Vec2& lower_left);

Fabric cotton();

}  // namespace vitrine::scene
