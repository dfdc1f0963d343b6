// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "vitrine/model/body.hpp"
#include "vitrine/model/garment_template.hpp"
#include "vitrine/model/panel.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

struct FitOptions {
  double clearance = 0.02;  ///< [m] of the placed panels from the body
};

/// Per panel, per node: where it hangs before it is sewn [m].
using Placement = std::vector<std::vector<Vec3>>;

/// Places the panels by their feature points before and behind the mannequin, turns limbs (sleeves) to follow the
/// body's arms, and pushes every node out of the voxels to its own side (paper III.C). Errors (65): NO_BODY,
/// NO_LANDMARK, PANEL_SIZE (panel and body sizes cannot belong together; the message proposes a factor).
Result<Placement> place_panels(const GarmentTemplate& garment, const Pattern& pattern, const Mannequin& mannequin,
                               const DistanceField& field, const FitOptions& options = {});

}  // namespace vitrine
