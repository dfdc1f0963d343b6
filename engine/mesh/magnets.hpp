// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "vitrine/model/geometry.hpp"
#include "wall.hpp"

namespace vitrine::mesh_room {

/// No interior node comes nearer to the wall than this share of the target edge: below it the plain law of the paper
/// presses nodes onto the outline and leaves flat triangles there.
inline constexpr double kClearance = 0.55;

/// Signed area of a closed polygon [m^2], positive counter-clockwise.
double polygon_area(std::span<const Vec2> outline);

/// Interior nodes a uniform mesh of this outline has: Euler's formula with equilateral triangles.
double ideal_interior_count(double area, std::size_t outline_size, double edge_length);

/// Interior nodes on a hexagonal lattice that is symmetric about the middle of the box, as many as a uniform mesh
/// needs: those farthest from the wall. `shift` 0 puts a node on the middle line of the first row, 0.5 a gap.
std::vector<Vec2> insert_magnets(std::span<const Vec2> outline, const Wall& wall, double edge_length, double shift);

/// Lets the nodes from `outline_size` on repel each other until they rest, held in by the wall. Returns the sweeps
/// used.
int settle(std::vector<Vec2>& nodes, std::size_t outline_size, const Wall& wall, double edge_length, int max_sweeps);

}  // namespace vitrine::mesh_room
