// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vitrine/model/body.hpp"
#include "vitrine/model/garment_template.hpp"
#include "vitrine/model/panel.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

/// When front and back are kept from passing through each other on the last level.
enum class FrontBack {
  where_crossed,  ///< looked for at rest, and only then relaxed again
  never,
  always  ///< the cloth at rest is relaxed again even where nothing crossed
};

struct SewingOptions {
  double residual = 1e-3;           ///< [-] stop: sum of |net force| / weight on the last level
  double coarse_residual = 3e-2;    ///< [-] the same on all other levels
  int max_iterations = 60'000;      ///< per level; a budget of work, never of seconds
  double gravity = 9.81;            ///< [m/s^2]
  double offset = 0.004;            ///< [m] skin offset: cloth surface to body
  double max_weight_strain = 1e-3;  ///< [-] k is capped where the weight strain falls below this (reported)
  /// The paper's own constants in place of the fabric's stretch, shear and mass: [N/m] of every spring and [kg] of
  /// every node of the last level; 0 = the fabric's, spread by area. What cloth that is depends on the mesh; nothing is
  /// capped.
  double spring_k = 0, node_mass = 0;
  /// [m] Stops at the first level whose error estimate, times 1.25, is within this, brought to `residual`; 0 = none.
  double max_error = 0;
  /// [node steps] Work after which no further level is begun, and the one in hand is left once it is close to rest
  /// (residual 1e-2), or given up for the one before; the first level is always brought that far. 0 = no limit.
  double max_work = 0;
  bool friction = true;
  bool bending = true;
  FrontBack front_back = FrontBack::where_crossed;
  /// The cloth at rest is relaxed again with contact at all edges and triangles, even where they do not cut in.
  bool contact_between_nodes = false;
  /// The cloth at rest is relaxed again with the stiffness that `max_weight_strain` took off.
  bool uncapped_at_rest = false;
  /// Called now and then with level, iteration and residual; may be empty.
  std::function<void(int, int, double)> progress;
};

struct LevelFigures {
  int nodes = 0, iterations = 0;
  double residual = 0;
  double change_mean_mm = 0, change_max_mm = 0;  ///< how far this level moved the one before
  double change_surface_mm = 0;                  ///< the part of it along the surface's normals, mean over the area
  double edge_mm = 0;                            ///< mean length of the mesh's edges
  double loose_turn = 0;                         ///< [rad] by which free cloth turns at an edge, mean over all cloth
  double gap_mm = 0;                             ///< from the skin offset to the cloth, mean over all cloth
  double error_estimate_mm = 0;                  ///< mean distance to what ever finer meshes would give
  double work = 0;                               ///< [node steps]
};

/// The garment at rest, and how much to believe it.
struct Drape {
  std::string status;  ///< "OK", NOT_CONVERGED, SEAM_OPEN, NOT_SUPPORTED, OVERSTRETCHED, INSIDE_BODY
  std::string detail;  ///< one sentence when the status is not OK
  int level = 0;       ///< the mesh level that this is on
  std::vector<std::vector<Vec3>> positions;        ///< [m] per panel, per node of that level; sewn nodes coincide
  std::vector<std::vector<std::uint32_t>> welded;  ///< per panel, per node: index of the sewn node
  double residual = 0;                             ///< recomputed independently of the solver's own stop test
  double seam_gap_mm_max = 0;     ///< largest distance of two sewn partners just before they were welded
  double penetration_mm_max = 0;  ///< deepest node or middle of an edge or triangle inside
  double strain_p99 = 0;          ///< [-] 99th percentile of |edge length / rest - 1|
  double stretch_p99 = 0;         ///< [-] 99th percentile of edge length / rest - 1: what decides OVERSTRETCHED
  double strain_max = 0;
  int self_touching = 0, self_crossed = 0;  ///< places where front and back lie on each other; have passed through
  double self_crossed_mm_max = 0;           ///< how far
  /// Mean distance [mm] of this surface to what ever finer meshes would give; none where the garment fell. See
  /// estimate_error() for what it is worth.
  std::optional<double> error_estimate_mm;
  double work = 0;           ///< [node steps] spent, on levels that were given up too
  bool out_of_work = false;  ///< max_work ended it
  double stiffness_cap = 0;  ///< [N/m] effective limit of k; 0 = not capped
  double energy = 0;         ///< [J]
  std::vector<LevelFigures> levels;
  std::vector<std::string> modelled, skipped;  ///< effects, with the reason
};

/// Mesh levels from coarse to fine that are made when they are needed.
struct PatternLevels {
  std::vector<int> nodes;  ///< per level: about how many nodes it has, both panels
  /// The pattern of a level, which stays in place; an error ends the sewing.
  std::function<Result<const Pattern*>(int level)> at;
  int count() const { return static_cast<int>(nodes.size()); }
};

/// Draws paired nodes together until they meet, welds them, and relaxes the mass-spring cloth (paper III.C, eq. (2)) to
/// rest on the body, coarse to fine. `placed` belongs to the first level; each later level starts from the one before.
/// `levels` share the panels' frame; on each the seams that have met before are welded from the start. Deterministic.
/// A garment that came out wrong is still returned, with its status; the gravest finding names it, in the order
/// NOT_SUPPORTED (it slid off and kept falling), SEAM_OPEN, INSIDE_BODY (> 0.5 mm), OVERSTRETCHED (stretch_p99 > 80 %),
/// NOT_CONVERGED.
/// Errors (64): FABRIC_TOO_SOFT (predicted weight strain > 100 %), FABRIC_VALUE (negative or non-finite k, m, ...),
/// SEWING_OPTION; (65): PATTERN_LEVELS, PATTERN_PANELS, PATTERN_MESH, PATTERN_PIECES, PATTERN_SEAM (wrong way round, or
/// edges more than three times as long as each other), PLACEMENT, NO_BODY, NOT_SUPPORTED
/// (placed beside the body).
Result<Drape> sew_and_drape(const PatternLevels& levels, const std::vector<std::vector<Vec3>>& placed,
                            const Fabric& fabric, const DistanceField& body, const SewingOptions& options = {});
/// The same with all levels made before.
Result<Drape> sew_and_drape(std::span<const Pattern> levels, const std::vector<std::vector<Vec3>>& placed,
                            const Fabric& fabric, const DistanceField& body, const SewingOptions& options = {});

}  // namespace vitrine
