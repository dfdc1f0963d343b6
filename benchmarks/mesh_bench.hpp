// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "vitrine/mesh.hpp"

namespace CLI {
class App;
}

namespace vitrine::bench {

/// `mesh`: one outline file, one JSON line. Returns what runs it, giving the exit code.
std::function<int()> add_mesh_command(CLI::App& app);
/// `mesh-peers`: this mesher, gmsh's frontal one (where configured) and CGAL's Mesh_2 with Lloyd, on the same outlines.
std::function<int()> add_mesh_peers_command(CLI::App& app);

/// An outline with its holes, and the edge length it was made for.
struct OutlineCase {
  std::string name;
  double edge_length = 0;  ///< [m]
  std::vector<Vec2> outline;
  std::vector<std::vector<Vec2>> holes;
};

/// Reads a .poly file: "count edge-length", then count lines "x y" [m]; every further "count" line begins a hole.
/// Throws std::runtime_error naming the file and the line.
OutlineCase read_poly(const std::string& file);

/// Processor time of the process [ms]: other programs on the machine do not count.
double cpu_ms();
double median(std::vector<double> values);

/// Nodes, triangles and the quality figures; shares in percent.
nlohmann::ordered_json figures_json(const MeshStats& stats);

/// A mesher of another project: the mesh, and the processor time inside it alone [ms].
struct PeerRun {
  PanelMesh mesh;
  double ms = 0;
};
/// gmsh's frontal-Delaunay mesher on one thread, its boundary nodes kept. Throws where the build is without gmsh.
PeerRun run_gmsh_frontal(const OutlineCase& outline);
bool have_gmsh();
/// CGAL's Mesh_2 refinement, then `rounds` of Lloyd. It splits boundary segments.
PeerRun run_cgal_lloyd(const OutlineCase& outline, int rounds);

/// One row of the comparison.
struct PeerRow {
  std::string outline, mesher;
  double edge_length = 0;  ///< [m]
  double ms = 0;           ///< median
  MeshStats stats;
};
void write_csv(const std::vector<PeerRow>& rows, const std::string& file);
/// Time and evenness over the node count, one line per mesher.
void write_svg(const std::vector<PeerRow>& rows, const std::string& file);

}  // namespace vitrine::bench
