// SPDX-License-Identifier: GPL-3.0-or-later
#include "outline.hpp"

#include <algorithm>
#include <cmath>

#include "simple.hpp"

namespace vitrine::panels_room {
namespace {

Error degenerate(Side side, const std::string& why) {
  return {
      Cause::unusable, "DEGENERATE_OUTLINE",
      std::string("The outline of the ") + side_name(side) + " photo cannot become a panel: " + why + ".",
      "Lay the garment flat with its sleeves clear of the body and retake the photo, or correct the feature points.",
      "panels"};
}

/// The contour clockwise in the picture, with each feature's place on it.
struct Walk {
  std::vector<Vec2> contour;
  std::vector<int> place;
  int gap(int from, int to) const {
    const int n = static_cast<int>(contour.size());
    return (place[to] - place[from] + n) % n;
  }
};

Walk clockwise(const Features& features) {
  Walk walk{features.contour, {}};
  const int n = static_cast<int>(walk.contour.size());
  for (const FeaturePoint& p : features.points) walk.place.push_back(p.contour_index);
  double twice_area = 0;  // y points down: positive is clockwise to the eye
  for (int i = 0; i < n; ++i) {
    const Vec2 a = walk.contour[i] - walk.contour[0], b = walk.contour[(i + 1) % n] - walk.contour[0];
    twice_area += a.x() * b.y() - a.y() * b.x();
  }
  if (twice_area < 0) {
    std::reverse(walk.contour.begin(), walk.contour.end());
    for (int& i : walk.place) i = n - 1 - i;
  }
  return walk;
}

bool is_edge_end(const GarmentTemplate& garment, int feature) {
  return std::any_of(garment.edges.begin(), garment.edges.end(),
                     [&](const TemplateEdge& e) { return e.from == feature || e.to == feature; });
}

/// Features that lie inside edge `e`, by their place on it.
std::vector<int> features_inside(const Walk& walk, const GarmentTemplate& garment, const TemplateEdge& e) {
  std::vector<int> inside;
  for (int f = 0; f < static_cast<int>(walk.place.size()); ++f)
    if (!is_edge_end(garment, f) && walk.gap(e.from, f) > 0 && walk.gap(e.from, f) < walk.gap(e.from, e.to))
      inside.push_back(f);
  std::stable_sort(inside.begin(), inside.end(),
                   [&](int a, int b) { return walk.gap(e.from, a) < walk.gap(e.from, b); });
  return inside;
}

/// Arc position on the curve nearest to p, sought in small steps.
double nearest_arc(const Curve& curve, const Vec2& p, double step) {
  const int steps = std::max(1, static_cast<int>(curve.length() / step));
  double best = 0, best_distance = (curve.at(0) - p).norm();
  for (int i = 1; i <= steps; ++i) {
    const double s = curve.length() * i / steps, d = (curve.at(s) - p).norm();
    if (d < best_distance) {
      best = s;
      best_distance = d;
    }
  }
  return best;
}

double signed_area(const std::vector<Vec2>& outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i] - outline[0], b = outline[(i + 1) % outline.size()] - outline[0];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

/// Adds a stop unless it crowds another one or an end: two nodes closer than this would make slivers.
void add_stop(EdgeCurve& edge, const Stop& stop, int feature, double spacing) {
  const auto crowds = [&](const Stop& s) { return std::abs(s.arc - stop.arc) < spacing; };
  if (feature < 0 && std::any_of(edge.stops.begin(), edge.stops.end(), crowds)) return;
  const auto at = std::upper_bound(edge.stops.begin(), edge.stops.end(), stop,
                                   [](const Stop& a, const Stop& b) { return a.arc < b.arc; });
  edge.stop_feature.insert(edge.stop_feature.begin() + (at - edge.stops.begin()), feature);
  edge.stops.insert(at, stop);
}

}  // namespace

const char* side_name(Side side) {
  return side == Side::front ? "front" : "back";
}

Result<std::vector<EdgeCurve>> cut_at_features(const Features& features, const GarmentTemplate& garment,
                                               const Affine2& pixel_from_panel, double edge_length, Side side) {
  const Walk walk = clockwise(features);
  const int n = static_cast<int>(walk.contour.size());
  int covered = 0;
  for (const TemplateEdge& e : garment.edges) {
    if (walk.gap(e.from, e.to) == 0)
      return degenerate(
          side, "the features " + garment.features[e.from].name + " and " + garment.features[e.to].name + " coincide");
    covered += std::min(walk.gap(e.from, e.to), n);
    if (covered > n) break;
  }
  if (covered != n) return degenerate(side, "its features do not follow each other in the template's order");

  const Affine2 panel_from_pixel = pixel_from_panel.inverse();
  const double pixel = panel_from_pixel.axis_x.norm();
  // The stair steps are two or three pixels long; above that the cloth's own scale decides.
  const double window = std::max(2.5 * pixel, 0.15 * edge_length);
  std::vector<EdgeCurve> edges;
  for (const TemplateEdge& e : garment.edges) {
    std::vector<Vec2> points{panel_from_pixel(features.points[e.from].pixel)};
    const auto append = [&](const Vec2& p) {
      if (p != points.back()) points.push_back(p);
    };
    const int gap = walk.gap(e.from, e.to);
    for (int k = 1; k < gap; ++k) append(panel_from_pixel(walk.contour[(walk.place[e.from] + k) % n]));
    const Vec2 last = panel_from_pixel(features.points[e.to].pixel);
    while (points.size() > 1 && points.back() == last) points.pop_back();
    append(last);
    if (points.size() < 2) return degenerate(side, "the edge " + e.name + " has no length");
    EdgeCurve edge{Curve(points, window), {}, {}};
    for (int f : features_inside(walk, garment, e)) {
      const Vec2 p = panel_from_pixel(features.points[f].pixel);
      const double arc = nearest_arc(edge.curve, p, 0.5 * pixel);
      if (arc > 0 && arc < edge.curve.length()) add_stop(edge, {arc, p}, f, 0);
    }
    // Sewn edges keep their nodes in step with their partner; only open ones bend to their own corners.
    if (e.kind != EdgeKind::seam)
      for (const Stop& stop : edge.curve.sharp_corners(0.7 * edge_length)) add_stop(edge, stop, -1, 0.7 * edge_length);
    edges.push_back(std::move(edge));
  }
  return edges;
}

Result<Panel> assemble(const std::vector<EdgeCurve>& curves, const std::vector<int>& segments, const Features& features,
                       const GarmentTemplate& garment, const Affine2& pixel_from_panel, double edge_length, Side side) {
  const Affine2 panel_from_pixel = pixel_from_panel.inverse();
  Panel panel;
  panel.side = side;
  panel.pixel_from_panel = pixel_from_panel;
  panel.corner.assign(garment.features.size(), -1);
  std::vector<bool> fixed;
  std::vector<int> start;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const int from = garment.edges[k].from;
    start.push_back(static_cast<int>(panel.outline.size()));
    panel.corner[from] = start.back();
    panel.outline.push_back(panel_from_pixel(features.points[from].pixel));
    fixed.push_back(true);
    for (const Vec2& p : inner_nodes(curves[k].curve, segments[k], curves[k].stops)) {
      const auto& stops = curves[k].stops;
      const auto stop = std::find_if(stops.begin(), stops.end(), [&](const Stop& s) { return s.position == p; });
      const int feature = stop == stops.end() ? -1 : curves[k].stop_feature[stop - stops.begin()];
      if (feature >= 0) panel.corner[feature] = static_cast<int>(panel.outline.size());
      panel.outline.push_back(p);
      fixed.push_back(stop != stops.end());
    }
  }
  for (std::size_t f = 0; f < panel.corner.size(); ++f)
    if (panel.corner[f] < 0) return degenerate(side, "the feature " + garment.features[f].name + " lies on no edge");

  // Clockwise to the eye in the picture is clockwise with y up too: turn the walk round, keeping node 0.
  const int n = static_cast<int>(panel.outline.size());
  std::reverse(panel.outline.begin() + 1, panel.outline.end());
  std::reverse(fixed.begin() + 1, fixed.end());
  for (int& c : panel.corner) c = (n - c) % n;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const int end = k + 1 == curves.size() ? n : start[k + 1];
    panel.edges.push_back({static_cast<int>(k), (n - end) % n, (n - start[k]) % n});
  }

  // Wide enough that the two sides of a slit stay apart, far too narrow to be seen on the cloth.
  const double gap = std::min(0.1 * edge_length, 0.002);
  open_slits(panel.outline, fixed, gap);
  if (!untangle(panel.outline, fixed, 4 * edge_length, gap)) return degenerate(side, "it crosses itself");
  if (!(signed_area(panel.outline) > 0)) return degenerate(side, "it has no area");
  return panel;
}

}  // namespace vitrine::panels_room
