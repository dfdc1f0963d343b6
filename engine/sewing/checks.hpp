// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "cloth.hpp"
#include "vitrine/sewing.hpp"

namespace vitrine::sewing {

/// Refuse what cannot be simulated: bad numbers, indices out of range, a fabric that cannot hold itself, panels that
/// are not at the body. `measure` is the level that as_sheet() and column_weight() look at.
std::optional<Error> check_input(const Pattern& first, const Pattern& measure, const Positions& placed,
                                 const Fabric& fabric, const DistanceField& body, const SewingOptions& options);
std::optional<Error> check_count(const PatternLevels& levels);
std::optional<Error> check_level(const Pattern& pattern, int level);

/// Nodes of both panels.
double nodes_of(const Pattern& pattern);

/// The fabric, with the options' spring_k and node_mass as what they come to on this mesh as a sheet (exact where it is
/// equilateral).
Fabric as_sheet(const Pattern& pattern, Fabric fabric, const SewingOptions& options);

/// Weight of the longest column of cloth per width [N/m]: divided by K it is the strain of the cloth under itself.
double column_weight(const Pattern& pattern, const Fabric& fabric, double gravity);

}  // namespace vitrine::sewing
