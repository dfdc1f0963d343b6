// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>

#include "mesh_bench.hpp"

#ifdef VITRINE_HAVE_GMSH
#include <gmsh.h>

#include <map>
#endif

namespace vitrine::bench {

#ifdef VITRINE_HAVE_GMSH

namespace {

/// One loop as points and straight lines that gmsh may not divide; returns the curve loop's tag.
int add_loop(const std::vector<Vec2>& loop, double h) {
  std::vector<int> points, lines;
  for (const Vec2& p : loop) points.push_back(gmsh::model::geo::addPoint(p.x(), p.y(), 0, h));
  for (std::size_t i = 0; i < points.size(); ++i)
    lines.push_back(gmsh::model::geo::addLine(points[i], points[(i + 1) % points.size()]));
  for (const int line : lines) gmsh::model::geo::mesh::setTransfiniteCurve(line, 2);
  return gmsh::model::geo::addCurveLoop(lines);
}

}  // namespace

bool have_gmsh() {
  return true;
}

PeerRun run_gmsh_frontal(const OutlineCase& outline) {
  const double h = outline.edge_length;
  gmsh::initialize();
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.NumThreads", 1);
  gmsh::option::setNumber("Mesh.Algorithm", 6);  // frontal-Delaunay
  gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
  gmsh::option::setNumber("Mesh.MeshSizeMax", h);
  gmsh::option::setNumber("Mesh.MeshSizeMin", h);
  gmsh::model::add("panel");
  std::vector<int> loops{add_loop(outline.outline, h)};
  for (const auto& hole : outline.holes) loops.push_back(add_loop(hole, h));
  gmsh::model::geo::addPlaneSurface(loops);
  gmsh::model::geo::synchronize();
  PeerRun run;
  const double start = cpu_ms();
  gmsh::model::mesh::generate(2);
  run.ms = cpu_ms() - start;

  std::vector<std::size_t> tags, types, corners;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters);
  std::map<std::size_t, std::uint32_t> index;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    index[tags[i]] = static_cast<std::uint32_t>(i);
    run.mesh.nodes.emplace_back(coordinates[3 * i], coordinates[3 * i + 1]);
  }
  constexpr int kTriangle = 2;
  gmsh::model::mesh::getElementsByType(kTriangle, types, corners);
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
    run.mesh.triangles.push_back({index.at(corners[i]), index.at(corners[i + 1]), index.at(corners[i + 2])});
  gmsh::finalize();
  return run;
}

#else

bool have_gmsh() {
  return false;
}

PeerRun run_gmsh_frontal(const OutlineCase&) {
  throw std::runtime_error("built without gmsh (Debian package libgmsh-dev)");
}

#endif

}  // namespace vitrine::bench
