// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "audit.hpp"
#include "vitrine/sewing.hpp"

namespace vitrine::sewing {

/// What the Tailor decided on and found, for the report.
struct SceneNotes {
  double bend = 0, friction = 0;  ///< of the fabric
  double voxels_in_reach = 0;     ///< [-] share of the body's field that lies in the garment's box at rest
  int between_nodes = 0;          ///< contact samples between nodes, on the last level
  bool cut_in = false;            ///< at first edges or triangles cut into the body: all of them are looked at
  SelfContact crossed;            ///< front and back before they were held apart; nothing crossed: they were not
  SelfContact left;               ///< front and back in the result
};

/// Share [-] of the field's voxels in the garment's box.
double share_in_reach(const Positions& positions, const DistanceField& body);

/// Fills `modelled` and `skipped`: each effect once, with the reason and, where a look at the result decided, what was
/// found.
void list_effects(const SewingOptions& options, const SceneNotes& notes, Drape& out);

}  // namespace vitrine::sewing
