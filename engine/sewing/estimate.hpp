// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>

#include "cloth.hpp"
#include "vitrine/model/body.hpp"
#include "vitrine/sewing.hpp"

namespace vitrine::sewing {

/// How far the surface moved from `before` to `now` [m]: the part of the nodes' ways along its normals, mean over the
/// area of the cloth. Cloth that slides along itself has not moved.
double surface_change(const Pattern& pattern, const Positions& before, const Positions& now);

/// Share of the nodes that lie more than a centimetre above the skin offset.
double loose_share(const Pattern& pattern, const Positions& positions, const DistanceField& body, double offset);

/// Mean closest distance [mm] of the last level's surface to what ever finer meshes would give: from how far it moved
/// the surface of the level before, or, on the first level, from the edge length and how much of the cloth hangs free.
/// Rest shapes under friction are not unique, so it is meant for one way of getting there, and is no bound.
double estimate_error(std::span<const LevelFigures> levels);

}  // namespace vitrine::sewing
