// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "envelope.hpp"
#include "gaps.hpp"
#include "limb.hpp"

namespace vitrine {
namespace {

std::string millimetres(double metres) {
  return std::to_string(std::lround(metres * 1e3)) + " mm";
}

/// Whether a seam has to pass below the arms: any but the shoulder line, which is the run of seams that leaves the neck
/// edge on either side. A garment without a neck edge hangs below the arms.
bool sewn_under_arms(const GarmentTemplate& garment) {
  const int neck = garment.neck_edge(), count = static_cast<int>(garment.edges.size());
  if (neck < 0) return true;
  std::vector<char> shoulder_line(garment.edges.size(), 0);
  for (const int step : {1, count - 1})
    for (int e = (neck + step) % count; garment.edges[e].kind == EdgeKind::seam; e = (e + step) % count)
      shoulder_line[e] = 1;
  for (int e = 0; e < count; ++e)
    if (garment.edges[e].kind == EdgeKind::seam && shoulder_line[e] == 0) return true;
  return false;
}

/// How much narrower [-] a panel is laid, level by level, so that its sides hang between trunk and arms and are not
/// sewn around the arms. Sewing lets the cloth out again around the trunk.
class Narrowing {
 public:
  /// `trunk`: the outline's nodes that belong to no limb. A garment without limbs has its armholes in the sides.
  Narrowing(const Gaps& gaps, const std::vector<Vec2>& trunk, bool has_limbs) {
    if (trunk.empty()) return;
    bottom_ = top_ = trunk.front().y();
    for (const Vec2& q : trunk) bottom_ = std::min(bottom_, q.y()), top_ = std::max(top_, q.y());
    const int rows = static_cast<int>((top_ - bottom_) / step) + 1;
    for (const int side : {-1, 1}) {
      std::vector<double> width(static_cast<std::size_t>(rows), 0.0);
      for (const Vec2& q : trunk) {
        double& w = width[static_cast<std::size_t>((q.y() - bottom_) / step)];
        w = std::max(w, side * q.x());
      }
      std::vector<double> raw;
      for (int r = 0; r < rows; ++r) {
        // The side runs straight between the outline's nodes: a level without one borrows from its neighbours.
        double w = width[r];
        for (int near = 1; w == 0 && near < rows; ++near)
          w = std::max(r >= near ? width[r - near] : 0.0, r + near < rows ? width[r + near] : 0.0);
        const double y = bottom_ + (r + 0.5) * step;
        const double gap = has_limbs ? gaps.middle(y, side) : gaps.middle_or_armpit(y, side);
        raw.push_back(w > 0 ? std::min(1.0, gap / w) : 1.0);
      }
      std::vector<double>& smooth = share_[side > 0];
      for (int r = 0; r < rows; ++r) {
        double sum = 0;
        int count = 0;
        for (int n = std::max(0, r - reach); n <= std::min(rows - 1, r + reach); ++n, ++count) sum += raw[n];
        smooth.push_back(sum / count);
      }
    }
  }
  double operator()(const Vec2& q) const {
    const std::vector<double>& share = share_[q.x() > 0];
    if (share.empty()) return 1;
    const auto row = static_cast<int>((q.y() - bottom_) / step);
    return share[static_cast<std::size_t>(std::clamp(row, 0, static_cast<int>(share.size()) - 1))];
  }

 private:
  static constexpr double step = 0.01;  // [m]
  static constexpr int reach = 3;       // levels to either side
  double bottom_ = 0, top_ = 0;
  std::vector<double> share_[2];
};

/// How far [m] a panel is lifted onto the body. Feature points to body segments: each anchor, or the mean of an anchor
/// and its mirror partner, goes to its landmark's height; a little above, so that a shoulder seam closes over the body
/// and not in it, or below where the outline turns inwards there: a crotch closes under the body. Of several the lowest
/// counts: trousers with a short rise hang from the crotch and sit below the waist, others hang from the waist.
Result<double> height_on_body(const GarmentTemplate& garment, const Panel& panel, const Mannequin& mannequin,
                              double clearance) {
  std::vector<double> lift(garment.features.size(), std::numeric_limits<double>::infinity());
  for (const int feature : garment.anchors) {
    const auto found = mannequin.landmarks.find(garment.features[feature].landmark);
    if (found == mannequin.landmarks.end())
      return Error{Cause::unusable, "NO_LANDMARK",
                   "the mannequin has no landmark \"" + garment.features[feature].landmark + "\"",
                   "use another mannequin, or correct the feature's landmark in the garment plugin", "fit"};
    const double off = garment.features[feature].turn == Turn::concave ? -clearance : clearance;
    lift[feature] = found->second.y() - panel.outline[panel.corner[feature]].y() + off;
  }
  double lowest = std::numeric_limits<double>::infinity();
  for (const int feature : garment.anchors) {
    const int partner = garment.features[feature].mirror;
    const bool both = partner >= 0 && std::isfinite(lift[partner]);
    lowest = std::min(lowest, both ? (lift[feature] + lift[partner]) / 2 : lift[feature]);
  }
  return std::isfinite(lowest) ? lowest : clearance;
}

}  // namespace

Result<Placement> place_panels(const GarmentTemplate& garment, const Pattern& pattern, const Mannequin& mannequin,
                               const DistanceField& field, const FitOptions& options) {
  if (field.values.empty())
    return Error{Cause::unusable, "NO_BODY", "the body's distance field is empty", "voxelise the mannequin first",
                 "fit"};
  double body_height = 0;
  for (const Vec3& v : mannequin.mesh.vertices) body_height = std::max(body_height, v.y());

  const Envelope before(field, +1), behind(field, -1);
  const Gaps gaps(mannequin, field);
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

    const Result<double> lift = height_on_body(garment, panel, mannequin, options.clearance);
    if (!lift) return lift.error();
    const Vec2 shift(0, *lift);

    std::vector<LimbBend> bends;
    for (const TemplateLimb& limb : garment.limbs) {
      auto bend = LimbBend::make(limb, panel, mannequin, field, shift, 0.5 * options.clearance);
      if (!bend) return bend.error();
      bends.push_back(*std::move(bend));
    }

    std::vector<Vec2> trunk;
    for (const Vec2& q : panel.outline)
      if (std::all_of(bends.begin(), bends.end(), [&](const LimbBend& b) { return b.weight(q + shift) == 0; }))
        trunk.push_back(q + shift);
    // Sides that nothing is sewn to (a poncho's) hang over the arms and keep their width.
    if (!sewn_under_arms(garment)) trunk.clear();
    const Narrowing narrowing(gaps, trunk, !bends.empty());

    const double outwards = panel.side == Side::front ? 1 : -1;
    const Envelope& sheet = panel.side == Side::front ? before : behind;
    std::vector<Vec3> nodes;
    nodes.reserve(mesh.nodes.size());
    for (const Vec2& rest : mesh.nodes) {
      const Vec2 placed = rest + shift;
      const double x = placed.x() * narrowing(placed);
      Vec3 q(x, placed.y(), sheet(x, placed.y()) + outwards * options.clearance);
      for (const LimbBend& bend : bends) {
        const double weight = bend.weight(placed);
        if (weight > 0) q += weight * (bend.on_limb(placed, outwards, gaps) - q);
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
