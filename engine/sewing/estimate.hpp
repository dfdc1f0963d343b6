// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cloth.hpp"
#include "vitrine/model/body.hpp"
#include "vitrine/sewing.hpp"

namespace vitrine::sewing {

/// How far the surface moved from `before` to `now` [m]: the part of the nodes' ways along its normals, mean over the
/// area of the cloth. Cloth that slides along itself has not moved.
double surface_change(const Pattern& pattern, const Positions& before, const Positions& now);

/// How folded the cloth is for its mesh: the angle [rad] by which the surface turns at an edge, mean over the area of
/// the cloth, where edges less than a centimetre above the skin offset count as flat: what the body holds is right on
/// every mesh.
double loose_turn(const Pattern& pattern, const Positions& x, const DistanceField& body, double offset);

/// Distance [m] from the skin offset to the cloth, mean over its area.
double mean_gap(const Pattern& pattern, const Positions& x, const DistanceField& body, double offset);

/// Mean closest distance [mm] of a level's surface to what ever finer meshes would give, from `loose_turn`, `edge_mm`
/// and `gap_mm`. Rest shapes under friction are not unique, so it is meant for one way of getting there, and is no
/// bound.
double estimate_error(const LevelFigures& level);

}  // namespace vitrine::sewing
