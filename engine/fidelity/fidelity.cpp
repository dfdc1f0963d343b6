// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/fidelity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "align.hpp"

namespace vitrine {
namespace {

using fidelity::Freedom;
using fidelity::Mask;

Error nothing(const std::string& what) {
  return Error{Cause::unusable, "NOTHING_TO_COMPARE", what + ": the garment cannot be compared with its photo",
               "check the silhouette with --debug-images and the drape's status in the report", "fidelity"};
}

/// Size and contents of the arrays, so that nothing below reads beyond them.
bool belong_together(const GarmentTemplate& garment, const Pattern& pattern,
                     std::span<const std::vector<Vec3>> positions) {
  const std::size_t count = pattern.panels.size();
  if (count == 0 || pattern.meshes.size() != count || positions.size() != count) return false;
  for (std::size_t i = 0; i < count; ++i) {
    const PanelMesh& mesh = pattern.meshes[i];
    const Panel& panel = pattern.panels[i];
    if (mesh.nodes.size() != positions[i].size() || mesh.nodes.size() < panel.outline.size()) return false;
    if (panel.corner.size() != garment.features.size() || panel.outline.size() < 3) return false;
    for (const int node : panel.corner)
      if (node < 0 || static_cast<std::size_t>(node) >= panel.outline.size()) return false;
    for (const Triangle& t : mesh.triangles)
      for (const std::uint32_t node : t)
        if (node >= mesh.nodes.size()) return false;
    for (const Vec3& p : positions[i])
      if (!p.allFinite()) return false;
  }
  return true;
}

/// Node of the front panel where its neckline is lowest, or -1.
int neck_low(const GarmentTemplate& garment, const Panel& panel) {
  const int edge = garment.neck_edge();
  const int n = static_cast<int>(panel.outline.size());
  int lowest = -1;
  for (const PanelEdge& e : panel.edges) {
    if (e.template_edge != edge || edge < 0) continue;
    for (int i = e.first;; i = (i + 1) % n) {
      if (lowest < 0 || panel.outline[i].y() < panel.outline[lowest].y()) lowest = i;
      if (i == e.last) break;
    }
  }
  return lowest;
}

std::vector<LandmarkMiss> find_misses(const GarmentTemplate& garment, const Panel& panel,
                                      const std::vector<fidelity::Sleeve>& sleeves, const std::vector<Vec3>& positions,
                                      const FlatToWorn& fit) {
  std::vector<LandmarkMiss> misses;
  const auto add = [&](const std::string& name, int node) {
    LandmarkMiss miss;
    miss.name = name;
    miss.flat = panel.outline[node];
    miss.expected = fit(miss.flat);
    miss.worn = positions[node].head<2>();
    miss.miss_mm = 1000 * (miss.worn - miss.expected).norm();
    misses.push_back(std::move(miss));
  };
  for (std::size_t f = 0; f < garment.features.size(); ++f) {
    const int node = panel.corner[f];
    const bool on_sleeve = std::any_of(sleeves.begin(), sleeves.end(), [&](const fidelity::Sleeve& s) {
      return std::find(s.nodes.begin() + 1, s.nodes.end() - 1, node) != s.nodes.end() - 1;
    });
    if (!on_sleeve) add(garment.features[f].name, node);
  }
  if (const int node = neck_low(garment, panel); node >= 0) add("neck_low", node);
  return misses;
}

/// Two legs that meet in a crotch, seen from the front.
struct Legs {
  Vec2 crotch = Vec2::Zero();             ///< [m] on the front panel
  double drop = 0;                        ///< [m] from there to the middles of the hems; 0: there are no legs
  double apart_flat = 0, apart_worn = 0;  ///< [m] between those middles
};

Legs legs_of(const GarmentTemplate& garment, const Panel& panel, const std::vector<Vec3>& positions) {
  Legs legs;
  for (std::size_t i = 0; i < garment.limbs.size(); ++i)
    for (std::size_t j = i + 1; j < garment.limbs.size(); ++j) {
      const TemplateLimb &a = garment.limbs[i], &b = garment.limbs[j];
      const bool shares_a = a.root_a == b.root_a || a.root_a == b.root_b;
      if (!shares_a && a.root_b != b.root_a && a.root_b != b.root_b) continue;
      const auto flat = [&](int feature) -> Vec2 { return panel.outline[panel.corner[feature]]; };
      const auto hem = [&](const TemplateLimb& limb) -> Vec2 { return (flat(limb.tip_a) + flat(limb.tip_b)) / 2; };
      const auto worn = [&](const TemplateLimb& limb) {
        return (positions[panel.corner[limb.tip_a]].x() + positions[panel.corner[limb.tip_b]].x()) / 2;
      };
      legs.crotch = flat(shares_a ? a.root_a : a.root_b);
      legs.drop = std::max(0.0, legs.crotch.y() - (hem(a) + hem(b)).y() / 2);
      legs.apart_flat = std::abs(hem(a).x() - hem(b).x());
      legs.apart_worn = std::abs(worn(a) - worn(b));
      return legs;
    }
  return legs;
}

/// From the fit of `iou` on: legs as far apart as the worn ones, then the camera turned by 2 degrees and ever less, as
/// long as the silhouettes overlap more.
void pose_photo(const Mask& photo, const Mask& worn, const Legs& legs, Fidelity& out) {
  constexpr double degree = std::numbers::pi / 180, most = 6 * degree, widest_swing = 0.5;
  Mask posed = photo;
  FlatToWorn fit = out.fit;
  out.iou_posed = out.iou;
  // How far apart the worn hems are on the photo depends on the width's scale, and that on where the legs are.
  for (int round = 0; round < 3 && legs.drop > 0.01; ++round) {
    out.leg_swing =
        std::clamp((legs.apart_worn / fit.width - legs.apart_flat) / 2 / legs.drop, -widest_swing, widest_swing);
    posed = fidelity::legs_swung(photo, legs.crotch, out.leg_swing);
    fit = fidelity::Overlay(posed, worn).align(fit, Freedom::two_scales, out.iou_posed);
  }
  for (double step = 2 * degree; step > 0.2 * degree; step /= 2)
    for (const double sign : {1.0, -1.0})
      for (double angle = out.camera_turn + sign * step; std::abs(angle) <= most; angle += sign * step) {
        double found = 0;
        const FlatToWorn tried =
            fidelity::Overlay(fidelity::turned(posed, angle), worn).align(fit, Freedom::two_scales, found);
        if (found <= out.iou_posed) break;
        out.iou_posed = found;
        out.camera_turn = angle;
        fit = tried;
      }
}

/// Both silhouettes of a fit as pictures of one frame.
void draw_masks(const Mask& photo, const Mask& worn, Fidelity& out) {
  const FlatToWorn& fit = out.fit;
  const Vec2 photo_high = fit(photo.top_left);
  const Vec2 photo_low = fit(photo.top_left + photo.pixel * Vec2(photo.width, -photo.height));
  const Vec2 worn_low = worn.top_left + worn.pixel * Vec2(worn.width, -worn.height);
  const double edge = 4 * worn.pixel;
  const Vec2 top_left(std::min(photo_high.x(), worn.top_left.x()) - edge,
                      std::max(photo_high.y(), worn.top_left.y()) + edge);
  const Vec2 bottom_right(std::max(photo_low.x(), worn_low.x()) + edge, std::min(photo_low.y(), worn_low.y()) - edge);
  const Mask frame({top_left.x(), bottom_right.y()}, {bottom_right.x(), top_left.y()}, worn.pixel);
  out.pixel = frame.pixel;
  out.top_left = frame.top_left;
  out.photo = out.worn = Image(frame.width, frame.height, 1);
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const Vec2 p = frame.centre(x, y), q = p - fit.shift;
      *out.worn.at(x, y) = worn.at(p) ? 255 : 0;
      *out.photo.at(x, y) = photo.at(Vec2(q.x() / fit.width, q.y() / fit.height)) ? 255 : 0;
    }
}

}  // namespace

Result<Fidelity> compare_with_photo(const Image& labels, const GarmentTemplate& garment, const Pattern& pattern,
                                    std::span<const std::vector<Vec3>> positions, const FidelityOptions& options) {
  if (options.rows < 64 || options.rows > 4096)
    return Error{Cause::usage, "BAD_FIDELITY_OPTION", "pictures of " + std::to_string(options.rows) + " rows",
                 "ask for 64 to 4096", "fidelity"};
  if (labels.empty() || labels.channels != 1) return nothing("the photo has no silhouette");
  if (!belong_together(garment, pattern, positions)) return nothing("the drape does not belong to the pattern");
  const Panel& front = pattern.panels.front();
  const auto sleeves = fidelity::sleeves_of(garment, front);
  const Mask photo = fidelity::photo_mask(labels, front, sleeves, options.rows);
  const Mask worn = fidelity::worn_mask(garment, pattern, positions, options.rows);
  if (photo.count() == 0) return nothing("nothing is left of the photo's silhouette");
  if (worn.count() == 0) return nothing("nothing is seen of the dressed garment");

  Fidelity out;
  for (const auto& sleeve : sleeves) out.left_out.push_back(sleeve.name);
  const fidelity::Overlay overlay(photo, worn);
  const FlatToWorn box = fidelity::box_on_box(photo, worn);
  // The true size starts from the middles of the boxes, the freer fits from the one before and from box on box.
  FlatToWorn start;
  const Vec2 photo_middle = photo.top_left + photo.pixel / 2 * Vec2(photo.width, -photo.height);
  start.shift = box(photo_middle) - photo_middle;
  const FlatToWorn shifted = overlay.align(start, Freedom::shift, out.iou_true_size);
  const FlatToWorn uniform = overlay.align(shifted, Freedom::one_scale, out.iou_uniform);
  out.uniform_scale = uniform.width;
  double from_box = 0;
  const FlatToWorn boxed = overlay.align(box, Freedom::two_scales, from_box);
  out.fit = overlay.align(uniform, Freedom::two_scales, out.iou);
  if (from_box > out.iou) {
    out.iou = from_box;
    out.fit = boxed;
  }
  pose_photo(photo, worn, legs_of(garment, front, positions.front()), out);
  out.landmarks = find_misses(garment, front, sleeves, positions.front(), out.fit);
  for (const LandmarkMiss& miss : out.landmarks) {
    out.landmark_mean_mm += miss.miss_mm / static_cast<double>(out.landmarks.size());
    out.landmark_max_mm = std::max(out.landmark_max_mm, miss.miss_mm);
  }
  draw_masks(photo, worn, out);
  return out;
}

Image draw_fidelity(const Fidelity& fidelity) {
  Image picture(fidelity.worn.width, fidelity.worn.height, 3, 255);
  const auto colour = [&](int x, int y, std::array<std::uint8_t, 3> rgb) {
    if (x >= 0 && y >= 0 && x < picture.width && y < picture.height)
      std::copy(rgb.begin(), rgb.end(), picture.at(x, y));
  };
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const bool photo = *fidelity.photo.at(x, y), worn = *fidelity.worn.at(x, y);
      if (photo && worn) colour(x, y, {205, 205, 205});
      if (photo && !worn) colour(x, y, {40, 90, 200});
      if (!photo && worn) colour(x, y, {235, 140, 40});
    }
  for (const LandmarkMiss& miss : fidelity.landmarks) {
    const auto place = [&](const Vec2& p) {
      return Vec2((p.x() - fidelity.top_left.x()) / fidelity.pixel, (fidelity.top_left.y() - p.y()) / fidelity.pixel);
    };
    const Vec2 from = place(miss.expected), to = place(miss.worn);
    const int steps = 1 + static_cast<int>(std::min(10'000.0, (to - from).norm()));
    for (int i = 0; i <= steps; ++i) {
      const Vec2 p = from + (to - from) * i / steps;
      colour(static_cast<int>(p.x()), static_cast<int>(p.y()), {0, 0, 0});
    }
    for (int dy = -3; dy <= 3; ++dy)
      for (int dx = -3; dx <= 3; ++dx)
        if (dx * dx + dy * dy <= 9)
          colour(static_cast<int>(from.x()) + dx, static_cast<int>(from.y()) + dy, {150, 0, 60});
  }
  return picture;
}

}  // namespace vitrine
