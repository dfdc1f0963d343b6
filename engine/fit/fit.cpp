// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/fit.hpp"

#include <algorithm>
#include <cmath>

#include "envelope.hpp"
#include "limb.hpp"

namespace vitrine {
namespace {

std::string millimetres(double metres) {
  return std::to_string(std::lround(metres * 1e3)) + " mm";
}

}  // namespace

Result<Placement> place_panels(const GarmentTemplate& garment, const Pattern& pattern, const Mannequin& mannequin,
                               const DistanceField& field, const FitOptions& options) {
  double body_height = 0;
  for (const Vec3& v : mannequin.mesh.vertices) body_height = std::max(body_height, v.y());

  const Envelope before(field, +1), behind(field, -1);
  Placement placement;
  for (std::size_t p = 0; p < pattern.panels.size(); ++p) {
    const Panel& panel = pattern.panels[p];
    const PanelMesh& mesh = pattern.meshes[p];

    Vec2 low = panel.outline.front(), high = low;
    for (const Vec2& q : panel.outline) low = low.cwiseMin(q), high = high.cwiseMax(q);
    const double size = (high - low).maxCoeff();
    if (!(size > 0.05 * body_height && size < 1.6 * body_height))
      return Error{Cause::unusable, "PANEL_SIZE",
                   "the " + std::string(p == 0 ? "front" : "back") + " panel is " + millimetres(size) +
                       " long on a mannequin of " + millimetres(body_height),
                   "check --chest-cm / --length-cm: they are flat measurements in centimetres", "fit"};

    // Feature points to body segments: the anchors' mean height goes to their landmarks', a little above so that the
    // shoulder seam closes over the body and not in it; sideways the panel stays centred on the body.
    double lift = 0;
    int anchors = 0;
    for (const int feature : garment.anchors) {
      const auto found = mannequin.landmarks.find(garment.features[feature].landmark);
      if (found == mannequin.landmarks.end())
        return Error{Cause::unusable, "NO_LANDMARK",
                     "the mannequin has no landmark \"" + garment.features[feature].landmark + "\"",
                     "use another mannequin, or correct the feature's landmark in the garment plugin", "fit"};
      lift += found->second.y() - panel.outline[panel.corner[feature]].y();
      ++anchors;
    }
    const Vec2 shift(0, (anchors ? lift / anchors : 0) + options.clearance);

    std::vector<LimbBend> bends;
    for (const TemplateLimb& limb : garment.limbs) {
      auto bend = LimbBend::make(limb, panel, mannequin, field, shift, 0.5 * options.clearance);
      if (!bend) return bend.error();
      bends.push_back(*std::move(bend));
    }

    const double outwards = panel.side == Side::front ? 1 : -1;
    const Envelope& sheet = panel.side == Side::front ? before : behind;
    std::vector<Vec3> nodes;
    nodes.reserve(mesh.nodes.size());
    for (const Vec2& rest : mesh.nodes) {
      const Vec2 placed = rest + shift;
      Vec3 q(placed.x(), placed.y(), sheet(placed.x(), placed.y()) + outwards * options.clearance);
      for (const LimbBend& bend : bends) {
        const double weight = bend.weight(placed);
        if (weight > 0) q += weight * (bend.on_limb(placed, outwards) - q);
      }
      // The sheet clears the body's voxels; what is still too near (a coarse grid's edge) moves on, to its own side.
      for (int i = 0; i < 64 && field.distance(q) < 0.5 * options.clearance; ++i) q.z() += outwards * field.spacing;
      nodes.push_back(q);
    }
    placement.push_back(std::move(nodes));
  }
  return placement;
}

}  // namespace vitrine
