// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <string>
#include <vector>

#include "vitrine/features.hpp"
#include "vitrine/model/panel.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

/// A level of the body that the garment may have to go round.
struct BodyLevel {
  double drop = 0;   ///< [m] below the landmarks that the garment's anchors hang on
  double girth = 0;  ///< [m]
};

struct PanelOptions {
  double edge_length = 0.02;  ///< [m] target spacing of outline nodes
  double chest = 0;           ///< [m] flat distance of the scale rule's features as the shop lists it; 0 = unknown
  double length = 0;          ///< [m] flat length, top to bottom of the scale rule; 0 = unknown
  std::map<std::string, double> girths;  ///< [m] body girths, for the plugin's ease when both are 0
  std::vector<BodyLevel> levels;  ///< with the ease, the garment is made wide enough for each level that it reaches
  double room = 0;  ///< [m] below the landmarks that the anchors hang on; with the ease, no garment is made longer. 0 =
                    ///< unknown
};

/// Both panels with their outlines resampled, and the seam pairs between them; meshes are still empty.
struct Panels {
  Panel front, back;
  std::vector<NodePair> pairs;  ///< panel index 0 = front, 1 = back; one to one along every seam, ends included
  double metres_per_pixel_front = 0, metres_per_pixel_back = 0;
  std::string scale_source;     ///< "chest", "length" or "ease"
  double worst_seam_ratio = 1;  ///< [-] longer / shorter of the two flat edges of a seam
  std::vector<std::string> warnings;
};

/// Template edges run clockwise in the picture, a panel's outline counter-clockwise: PanelEdge::first is the node of
/// the template edge's `to` feature and PanelEdge::last that of its `from` feature, on both panels alike.
///
/// Features to panels in metres: scaled, set upright, outline between features resampled so that the two edges of each
/// seam have the same number of nodes (by arc length).
/// Errors (65): FRONT_BACK_MISMATCH, DEGENERATE_OUTLINE; (64): BAD_MEASUREMENT (not within 0.05 m to 3 m),
/// MISSING_GIRTH, BAD_SETTING; (69): BAD_TEMPLATE. Warnings begin with SEAM_LENGTH or SCALE.
Result<Panels> make_panels(const Features& front, const Features& back, const GarmentTemplate& garment,
                           const PanelOptions& options);

}  // namespace vitrine
