// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/panels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "body_levels.hpp"
#include "frame.hpp"
#include "outline.hpp"

namespace vitrine {
namespace {

using namespace panels_room;

constexpr double kWarnRatio = 1.2, kLargestRatio = 3.0;  ///< [-] longer / shorter edge of a seam
constexpr double kTellShorter = 0.97;                    ///< [-] less is not worth a warning
constexpr double kMostNodes = 100'000;                   ///< [-] on one outline; a photo cannot show more

/// Scale, tilt and contour of one photo, and its template edges as curves.
struct Photographed {
  const Features& features;
  Side side;
  Affine2 affine;
  std::vector<EdgeCurve> edges;
};

Error bad_template(const std::string& why) {
  return {Cause::plugin, "BAD_TEMPLATE", "The garment template cannot be cut into panels: " + why + ".",
          "Report this to the author of the garment plugin.", "panels"};
}

Error bad_features(Side side, const std::string& why) {
  return {Cause::unusable, "DEGENERATE_OUTLINE",
          std::string("The features of the ") + side_name(side) + " photo cannot become a panel: " + why + ".",
          "Check the silhouette of this photo or retake it on a plain board.", "panels"};
}

/// The host checks templates when it adopts a plugin; what is indexed by them here is checked again.
Result<bool> check_template(const GarmentTemplate& garment) {
  const int features = static_cast<int>(garment.features.size()), edges = static_cast<int>(garment.edges.size());
  const auto is_feature = [&](int f) { return f >= 0 && f < features; };
  if (edges < 2) return bad_template("it has fewer than two edges");
  for (int k = 0; k < edges; ++k) {
    const TemplateEdge &e = garment.edges[k], &next = garment.edges[(k + 1) % edges];
    if (!is_feature(e.from) || !is_feature(e.to) || e.from == e.to)
      return bad_template("edge " + e.name + " has no ends");
    if (e.to != next.from) return bad_template("edge " + e.name + " does not lead to the next edge");
  }
  for (const TemplateFeature& f : garment.features)
    if (f.mirror >= features) return bad_template("the partner of feature " + f.name + " does not exist");
  for (const TemplateSeam& s : garment.seams) {
    const auto is_seam = [&](int e) { return e >= 0 && e < edges && garment.edges[e].kind == EdgeKind::seam; };
    if (!is_seam(s.edge_a) || !is_seam(s.edge_b)) return bad_template("a seam joins an edge that is no seam edge");
    if (s.side_a == s.side_b && s.edge_a == s.edge_b) return bad_template("a seam joins an edge to itself");
  }
  const ScaleRule& r = garment.scale;
  if (!is_feature(r.feature_a) || !is_feature(r.feature_b) || !is_feature(r.top) || !is_feature(r.bottom))
    return bad_template("its scale rule names a feature that does not exist");
  if (!std::all_of(garment.anchors.begin(), garment.anchors.end(), is_feature))
    return bad_template("an anchor names a feature that does not exist");
  return true;
}

Result<bool> check_features(const Features& features, const GarmentTemplate& garment, Side side) {
  const auto finite = [](const Vec2& p) { return p.allFinite() && p.cwiseAbs().maxCoeff() < 1e6; };
  if (features.points.size() != garment.features.size())
    return bad_features(side, "their number is not the template's");
  if (features.contour.size() < 3) return bad_features(side, "the contour has fewer than three points");
  if (!std::isfinite(features.tilt_deg)) return bad_features(side, "the tilt is not finite");
  if (!std::all_of(features.contour.begin(), features.contour.end(), finite))
    return bad_features(side, "a point of the contour is not in the photo");
  for (const FeaturePoint& p : features.points)
    if (!finite(p.pixel) || p.contour_index < 0 || p.contour_index >= static_cast<int>(features.contour.size()))
      return bad_features(side, "feature " + p.name + " does not lie on the contour");
  return true;
}

Result<Photographed> photographed(const Features& features, const std::vector<Vec2>& upright,
                                  const GarmentTemplate& garment, double metres_per_pixel, double shorter,
                                  double edge_length, Side side) {
  if (!std::isfinite(metres_per_pixel) || metres_per_pixel <= 0 || !std::isfinite(1 / metres_per_pixel))
    return bad_features(side, "its scale is not finite");
  Photographed photo{
      features, side, pixel_from_panel(upright, features.tilt_deg, metres_per_pixel, shorter, garment), {}};
  auto edges = cut_at_features(features, garment, photo.affine, edge_length, side);
  if (!edges) return edges.error();
  photo.edges = std::move(*edges);
  double total = 0;
  for (const EdgeCurve& e : photo.edges) total += e.curve.length();
  if (total / edge_length > kMostNodes)
    return Error{Cause::usage, "BAD_SETTING",
                 "An edge length of " + std::to_string(edge_length) + " m needs more than 100000 nodes on one outline.",
                 "Use a longer edge length, or check the scale of the garment.", "panels"};
  return photo;
}

std::string two_digits(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);
  return text.data();
}

/// Segments per edge and photo: a seam's two edges get one number, by the mean of their lengths.
Result<std::array<std::vector<int>, 2>> share_segments(const std::array<Photographed, 2>& photos,
                                                       const GarmentTemplate& garment, double edge_length,
                                                       Panels& panels) {
  std::array<std::vector<int>, 2> segments;
  const auto length = [&](Side s, int e) { return photos[static_cast<int>(s)].edges[e].curve.length(); };
  const auto stops = [&](Side s, int e) { return static_cast<int>(photos[static_cast<int>(s)].edges[e].stops.size()); };
  for (const Photographed& photo : photos)
    for (int e = 0; e < static_cast<int>(garment.edges.size()); ++e) {
      const int wanted = static_cast<int>(std::lround(length(photo.side, e) / edge_length));
      segments[static_cast<int>(photo.side)].push_back(std::max({1, wanted, stops(photo.side, e) + 1}));
    }
  std::array<std::vector<char>, 2> sewn;
  for (auto& s : sewn) s.assign(garment.edges.size(), false);
  for (const TemplateSeam& seam : garment.seams) {
    const int a = static_cast<int>(seam.side_a), b = static_cast<int>(seam.side_b);
    if (sewn[a][seam.edge_a] || sewn[b][seam.edge_b]) return bad_template("an edge is sewn twice");
    sewn[a][seam.edge_a] = sewn[b][seam.edge_b] = true;
    const double la = length(seam.side_a, seam.edge_a), lb = length(seam.side_b, seam.edge_b);
    const int wanted = static_cast<int>(std::lround(0.5 * (la + lb) / edge_length));
    segments[a][seam.edge_a] = segments[b][seam.edge_b] =
        std::max({2, wanted, stops(seam.side_a, seam.edge_a) + 1, stops(seam.side_b, seam.edge_b) + 1});
    const double ratio = std::max(la, lb) / std::min(la, lb);
    panels.worst_seam_ratio = std::max(panels.worst_seam_ratio, ratio);
    const std::string& name = garment.edges[seam.edge_a].name;
    if (!(ratio <= kLargestRatio))
      return Error{Cause::unusable, "FRONT_BACK_MISMATCH",
                   "The two edges of the seam " + name + " differ " + two_digits(ratio) +
                       " times in length between the front and the back photo.",
                   "Check that both photos show the same garment, laid out the same way.", "panels"};
    if (ratio > kWarnRatio)
      panels.warnings.push_back("SEAM_LENGTH: the edges of the seam " + name + " differ " + two_digits(ratio) +
                                " times in length between front and back");
  }
  return segments;
}

std::vector<NodePair> pair_seams(const Panels& panels, const GarmentTemplate& garment) {
  const std::array<const Panel*, 2> both{&panels.front, &panels.back};
  std::vector<NodePair> pairs;
  for (int s = 0; s < static_cast<int>(garment.seams.size()); ++s) {
    const TemplateSeam& seam = garment.seams[s];
    const int a = static_cast<int>(seam.side_a), b = static_cast<int>(seam.side_b);
    const PanelEdge &ea = both[a]->edges[seam.edge_a], &eb = both[b]->edges[seam.edge_b];
    const int na = static_cast<int>(both[a]->outline.size()), nb = static_cast<int>(both[b]->outline.size());
    const int count = (ea.last - ea.first + na) % na;
    for (int k = 0; k <= count; ++k) {
      const int node_b = seam.reversed ? (eb.last - k + nb) % nb : (eb.first + k) % nb;
      pairs.push_back({a, (ea.first + k) % na, b, node_b, s});
    }
  }
  return pairs;
}

}  // namespace

Result<Panels> make_panels(const Features& front, const Features& back, const GarmentTemplate& garment,
                           const PanelOptions& options) {
  const double h = options.edge_length;
  if (!std::isfinite(h) || h <= 0)
    return Error{Cause::usage, "BAD_SETTING", "The edge length is not a positive number.",
                 "Use an edge length above zero, in metres.", "panels"};
  if (const auto ok = check_template(garment); !ok) return ok.error();
  if (const auto ok = check_features(front, garment, Side::front); !ok) return ok.error();
  if (const auto ok = check_features(back, garment, Side::back); !ok) return ok.error();

  const std::vector<Vec2> upright_front = upright_pixels(front), upright_back = upright_pixels(back);
  const auto scale = front_scale(upright_front, garment, options);
  if (!scale) return scale.error();
  Panels panels;
  panels.scale_source = scale->source;
  if (!scale->warning.empty()) panels.warnings.push_back(scale->warning);
  panels.metres_per_pixel_front = scale->metres_per_pixel;
  if (scale->source == "ease")
    panels.metres_per_pixel_front = scale_for_body(scale->metres_per_pixel, upright_contour(front),
                                                   anchor_height(upright_front, garment), options.levels);
  double shorter = 1;
  if (scale->source == "ease")
    shorter = shortened(upright_contour(front), anchor_height(upright_front, garment), panels.metres_per_pixel_front,
                        options.room);
  if (shorter < kTellShorter)
    panels.warnings.push_back("SCALE: the garment is made " +
                              std::to_string(static_cast<int>(std::lround(100 * (1 - shorter)))) +
                              " % shorter than the photo shows; as wide as this body needs, it would reach the floor");
  const double width_back = scale_distance(upright_back, garment.scale);
  if (!(width_back >= 4)) return bad_features(Side::back, "those that measure its width lie within four pixels");
  panels.metres_per_pixel_back =
      panels.metres_per_pixel_front * scale_distance(upright_front, garment.scale) / width_back;

  auto photo_front =
      photographed(front, upright_front, garment, panels.metres_per_pixel_front, shorter, h, Side::front);
  if (!photo_front) return photo_front.error();
  auto photo_back = photographed(back, upright_back, garment, panels.metres_per_pixel_back, shorter, h, Side::back);
  if (!photo_back) return photo_back.error();
  const std::array<Photographed, 2> photos{std::move(*photo_front), std::move(*photo_back)};
  const auto segments = share_segments(photos, garment, h, panels);
  if (!segments) return segments.error();

  for (const Photographed& photo : photos) {
    const bool is_front = photo.side == Side::front;
    auto panel =
        assemble(photo.edges, (*segments)[is_front ? 0 : 1], photo.features, garment, photo.affine, h, photo.side);
    if (!panel) return panel.error();
    (is_front ? panels.front : panels.back) = std::move(*panel);
  }
  panels.pairs = pair_seams(panels, garment);
  return panels;
}

}  // namespace vitrine
