// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "vitrine/model/panel.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

struct MeshOptions {
  double edge_length = 0.02;  ///< [m] target
  int max_nodes = 200'000;    ///< refuse outlines that would need more (TOO_MANY_NODES)
  int max_sweeps = 200;       ///< magnet relaxation
};

/// Figures of a mesh. Edge ratio = (sum of the two shorter edges) / longest: 1 flat, 2 equilateral.
struct MeshStats {
  int nodes = 0, triangles = 0;
  int interior_nodes = 0;  ///< not on the border
  double min_angle_deg = 0, mean_min_angle_deg = 0;
  double flat_share = 0;      ///< [-] triangles with edge ratio < 1.3
  double good_share = 0;      ///< [-] triangles with edge ratio > 1.6
  double valence6_share = 0;  ///< [-] interior nodes that six edges meet at; 1 when there is no interior node
  double edge_mean = 0;       ///< [m]
  double edge_cv = 0;         ///< [-] coefficient of variation of edge lengths
};

/// Uniform mesh of a simple polygon (paper III.B): magnet node insertion, constrained Delaunay triangulation,
/// edge-ratio rules. The outline's own nodes and segments are kept exactly: nodes [0, outline.size()) are the outline.
/// Edge ratio = (sum of the two shorter edges) / longest: 1 flat, 2 equilateral.
/// Errors (65): DEGENERATE_OUTLINE (self-crossing, repeated points, zero area, non-finite), TOO_MANY_NODES; (64):
/// BAD_SETTING. Either winding is taken; triangles are counter-clockwise.
Result<PanelMesh> mesh_panel(std::span<const Vec2> outline, const MeshOptions& options = {},
                             std::span<const std::vector<Vec2>> holes = {});

/// Quality figures of any panel mesh.
MeshStats measure_mesh(const PanelMesh& mesh);

}  // namespace vitrine
