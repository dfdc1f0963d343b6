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
  int max_sweeps = 12;        ///< magnet relaxation, before the edge-ratio rules; half as many after each round of them
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

/// Uniform mesh of a polygon with holes (paper III.B): magnet node insertion, constrained Delaunay triangulation,
/// edge-ratio rules. The boundary's own nodes and segments are kept exactly: the mesh's first nodes are the outline,
/// then the holes, all in the order given; no other node lies on them. Edges are finer where a part is narrower than
/// four of them, down to a quarter of its width but not below half the target, and around boundary segments shorter
/// than 0.6 of the target. Segments longer than three targets leave sharp triangles on them: nothing may divide them.
/// Either winding is taken; triangles are counter-clockwise. Same input, same bytes.
/// Errors (65): DEGENERATE_OUTLINE (a loop that crosses or touches itself or another, repeated points, zero area, fewer
/// than three points, non-finite, a hole outside the outline), TOO_MANY_NODES; (64): BAD_SETTING.
Result<PanelMesh> mesh_panel(std::span<const Vec2> outline, const MeshOptions& options = {},
                             std::span<const std::vector<Vec2>> holes = {});

/// Quality figures of any panel mesh.
MeshStats measure_mesh(const PanelMesh& mesh);

}  // namespace vitrine
