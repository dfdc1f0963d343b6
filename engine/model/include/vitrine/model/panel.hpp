// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "vitrine/model/garment_template.hpp"
#include "vitrine/model/geometry.hpp"

namespace vitrine {

/// Stretch of a panel's outline that belongs to one template edge: nodes first, first+1, ... last (modulo the outline).
struct PanelEdge {
  int template_edge = 0;
  int first = 0, last = 0;
};

/// A flat piece of cloth: metres, x to the right of the front picture, y up, in the front frame (the back panel too).
struct Panel {
  Side side = Side::front;
  std::vector<Vec2> outline;     ///< closed polygon, counter-clockwise, no repeated last point
  std::vector<PanelEdge> edges;  ///< in the template's order; they cover the outline exactly once
  std::vector<int> corner;       ///< per template feature: its node on the outline
  Affine2 pixel_from_panel;      ///< metres to pixels of the (front-frame) photo
};

/// Nodes [0, outline size) are the panel's outline in order; interior nodes follow.
struct PanelMesh {
  std::vector<Vec2> nodes;          ///< metres, the cloth's rest shape
  std::vector<Triangle> triangles;  ///< counter-clockwise in the front frame
};

/// One pair of nodes that a seam joins.
struct NodePair {
  int panel_a = 0, node_a = 0;
  int panel_b = 0, node_b = 0;
  int seam = 0;  ///< index of the template seam
};

/// Everything that is sewn: panels with their meshes, and which nodes meet.
struct Pattern {
  std::vector<Panel> panels;      ///< front, back
  std::vector<PanelMesh> meshes;  ///< one for each panel
  std::vector<NodePair> pairs;
  double edge_length = 0;       ///< [m] target
  double metres_per_pixel = 0;  ///< of the front photo
};

}  // namespace vitrine
