// SPDX-License-Identifier: GPL-3.0-or-later
#include "audit.hpp"

#include <algorithm>
#include <cmath>

#include "layers.hpp"

namespace vitrine::sewing {
namespace {

constexpr double too_close = 0.001;      // [m]
constexpr double crossing_reach = 0.01;  // [m] deeper is not looked for: it would be another fold of the cloth

}  // namespace

Strains measure_strain(const Pattern& pattern, const Positions& positions) {
  std::vector<double> strain;
  for (std::size_t p = 0; p < pattern.meshes.size(); ++p) {
    const PanelMesh& m = pattern.meshes[p];
    for (const Triangle& t : m.triangles)
      for (int e = 0; e < 3; ++e) {
        const auto a = t[e], b = t[(e + 1) % 3];
        const double rest = (m.nodes[a] - m.nodes[b]).norm();
        if (rest < 1e-9) continue;
        strain.push_back((positions[p][a] - positions[p][b]).norm() / rest - 1);
      }
  }
  Strains s;
  if (strain.empty()) return s;
  const auto p99 = [&] {
    std::sort(strain.begin(), strain.end());
    return strain[static_cast<std::size_t>(0.99 * static_cast<double>(strain.size() - 1))];
  };
  s.stretch_p99 = p99();
  for (double& e : strain) e = std::abs(e);
  s.p99 = p99();
  s.most = strain.back();
  return s;
}

double measure_penetration(const Pattern& pattern, const Positions& positions, const DistanceField& body) {
  double deepest = 0;
  for (std::size_t p = 0; p < positions.size(); ++p) {
    const auto& x = positions[p];
    for (const Vec3& q : x) deepest = std::max(deepest, -body.distance(q));
    for (const Triangle& t : pattern.meshes[p].triangles) {
      deepest = std::max(deepest, -body.distance((x[t[0]] + x[t[1]] + x[t[2]]) / 3));
      for (int e = 0; e < 3; ++e) deepest = std::max(deepest, -body.distance((x[t[e]] + x[t[(e + 1) % 3]]) / 2));
    }
  }
  return deepest;
}

SelfContact detect_self_contact(const Pattern& pattern, const Nodes& nodes, const Positions& positions) {
  SelfContact found;
  for (const LayerPair& pair : find_layers(pattern, nodes, positions, crossing_reach)) {
    if (std::abs(pair.height) < too_close) ++found.close;
    if (pair.height > 0) {
      ++found.crossed;
      found.depth = std::max(found.depth, pair.height);
    }
  }
  return found;
}

}  // namespace vitrine::sewing
