// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "resample.hpp"
#include "vitrine/features.hpp"
#include "vitrine/model/panel.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine::panels_room {

/// One template edge on one photo: its curve in panel metres from feature `from` to feature `to`.
struct EdgeCurve {
  Curve curve;
  std::vector<Stop> stops;        ///< features and sharp corners inside the edge
  std::vector<int> stop_feature;  ///< the feature of each stop, -1 for a sharp corner
};

/// The contour cut at the features, in panel metres, one curve per template edge. Errors (65): DEGENERATE_OUTLINE.
Result<std::vector<EdgeCurve>> cut_at_features(const Features& features, const GarmentTemplate& garment,
                                               const Affine2& pixel_from_panel, double edge_length, Side side);

/// The panel with `segments[k]` segments on template edge k, counter-clockwise, checked to be simple.
/// Errors (65): DEGENERATE_OUTLINE.
Result<Panel> assemble(const std::vector<EdgeCurve>& curves, const std::vector<int>& segments, const Features& features,
                       const GarmentTemplate& garment, const Affine2& pixel_from_panel, double edge_length, Side side);

const char* side_name(Side side);

}  // namespace vitrine::panels_room
