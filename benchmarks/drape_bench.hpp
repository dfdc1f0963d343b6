// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vitrine/model/body.hpp"
#include "vitrine/model/panel.hpp"

namespace CLI {
class App;
}

namespace vitrine::bench {

/// `drape`: one workload of two panels and a body, sewn and draped; one JSON line. Returns what runs it, giving the
/// exit code.
std::function<int()> add_drape_command(CLI::App& app);

/// Two panels with one outline, their seams and a body, read from front.obj, back.obj, body.obj and seams.json (metres,
/// z up, wearer faces -y) and turned to y up, front +z.
struct DrapeCase {
  Pattern pattern;                    ///< the meshes as given
  std::vector<std::string> segments;  ///< per outline node: the name of the segment that leads to the next one
  std::vector<std::string> sewn;      ///< names of the segments that are sewn; NodePair::seam counts them
  double panel_distance = 0;          ///< [m] from the body's middle plane to the flat panels
  TriMesh body;
};
/// Throws std::runtime_error naming the file.
DrapeCase read_drape_case(const std::string& folder);

/// The case's outline with every segment resampled by arc length, meshed anew with about `nodes` nodes in both panels:
/// a coarser level of the same garment, its seams paired node by node. Throws where the mesher refuses.
Pattern coarser_pattern(const DrapeCase& input, int nodes);

/// The panels' flat places on either side of the body [m].
std::vector<std::vector<Vec3>> place_flat(const Pattern& pattern, double distance);

/// What the Blender script measures on its result, under the same names; inside and crossing against the body's
/// triangles themselves.
nlohmann::ordered_json drape_figures(const DrapeCase& input, const std::vector<std::vector<Vec3>>& positions);

/// Runs the peers' Blender script on the same folder, on one thread. Gives its figures; throws where it fails.
nlohmann::ordered_json run_blender(const std::string& script, const std::string& folder, double stop, int frames);

}  // namespace vitrine::bench
