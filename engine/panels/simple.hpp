// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "vitrine/model/geometry.hpp"

namespace vitrine::panels_room {

/// First pair of segments (i, j), i < j, of the closed polygon that cross or touch without being neighbours; or
/// neighbours that fold back onto each other.
std::optional<std::pair<int, int>> find_crossing(const std::vector<Vec2>& outline);

/// Removes small self-crossings that resampling made, without changing the number of nodes: the nodes of a loop shorter
/// than `largest_loop` [m] are laid evenly over the crossing; two stretches that cross elsewhere, by up to a quarter of
/// that, are each pushed to their own side until `gap` [m] lies between them. The outline runs counter-clockwise. Nodes
/// with fixed[i] stay; false when a crossing remains.
bool untangle(std::vector<Vec2>& outline, const std::vector<bool>& fixed, double largest_loop, double gap);

/// Keeps a slit (between a sleeve and the body it lies along) open after resampling: nodes of a counter-clockwise
/// outline nearer than `gap` [m] to another stretch across the outside are moved apart. Nodes with fixed[i] stay.
void open_slits(std::vector<Vec2>& outline, const std::vector<bool>& fixed, double gap);

}  // namespace vitrine::panels_room
