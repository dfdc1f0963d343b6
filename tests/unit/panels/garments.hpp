// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Garments with known measurements, "photographed" onto a pixel grid: drawn in metres, turned, scaled, and rounded to
// whole pixels as a chain code leaves them.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "vitrine/panels.hpp"

namespace vitrine::test {

struct Corner {
  std::string name, mirror;
  Vec2 metres;                ///< y up
  std::vector<Vec2> towards;  ///< inner points of the edge that follows, clockwise
};

struct Drawn {
  GarmentTemplate garment;
  std::vector<Corner> corners;
};

inline int index_of(const Drawn& d, const std::string& name) {
  for (std::size_t i = 0; i < d.corners.size(); ++i)
    if (d.corners[i].name == name) return static_cast<int>(i);
  return -1;
}

/// Completes the template of a drawing: features and edges follow the corners; `sewn` edges are front to back seams.
inline Drawn complete(std::vector<Corner> corners, const std::vector<std::pair<std::string, EdgeKind>>& edges) {
  Drawn d;
  d.corners = std::move(corners);
  const int n = static_cast<int>(d.corners.size());
  for (const Corner& c : d.corners) d.garment.features.push_back({c.name, "", index_of(d, c.mirror), Turn::any});
  for (int i = 0; i < n; ++i) {
    d.garment.edges.push_back({edges[i].first, i, (i + 1) % n, edges[i].second});
    if (edges[i].second == EdgeKind::seam) d.garment.seams.push_back({Side::front, Side::back, i, i, false});
  }
  return d;
}

inline std::vector<Vec2> bow(const Vec2& a, const Vec2& b, const Vec2& pull, int n = 60) {
  std::vector<Vec2> points;
  for (int i = 1; i < n; ++i) {
    const double t = static_cast<double>(i) / n;
    points.push_back((1 - t) * (1 - t) * a + 2 * t * (1 - t) * pull + t * t * b);
  }
  return points;
}

inline Drawn vest(double neck_depth = 0.12) {
  const Vec2 nl(-0.085, 0.63), nr(0.085, 0.63), sr(0.185, 0.60), ar(0.25, 0.39), hr(0.26, 0.0);
  const auto m = [](const Vec2& p) { return Vec2(-p.x(), p.y()); };
  Drawn d = complete({{"neck_left", "neck_right", nl, bow(nl, nr, {0, 0.63 - 2 * neck_depth})},
                      {"neck_right", "neck_left", nr, {}},
                      {"shoulder_right", "shoulder_left", sr, bow(sr, ar, {0.16, 0.42})},
                      {"armpit_right", "armpit_left", ar, {}},
                      {"hem_right", "hem_left", hr, {}},
                      {"hem_left", "hem_right", m(hr), {}},
                      {"armpit_left", "armpit_right", m(ar), bow(m(ar), m(sr), {-0.16, 0.42})},
                      {"shoulder_left", "shoulder_right", m(sr), {}}},
                     {{"neck", EdgeKind::neck},
                      {"shoulder_seam_right", EdgeKind::seam},
                      {"armhole_right", EdgeKind::open},
                      {"side_right", EdgeKind::seam},
                      {"hem", EdgeKind::open},
                      {"side_left", EdgeKind::seam},
                      {"armhole_left", EdgeKind::open},
                      {"shoulder_seam_left", EdgeKind::seam}});
  d.garment.scale = {index_of(d, "armpit_left"), index_of(d, "armpit_right"), "bust", 1.06,
                     index_of(d, "neck_left"),   index_of(d, "hem_left")};
  d.garment.anchors = {index_of(d, "neck_left"), index_of(d, "neck_right")};
  return d;
}

/// A V-neck with its tip inside the neck edge.
inline Drawn v_neck() {
  Drawn d = vest();
  d.corners[0].towards = {{0, 0.45}};
  return d;
}

/// Sleeves hanging beside the body, `slit` metres from it.
inline Drawn long_sleeve(double slit) {
  const Vec2 nr(0.085, 0.63), sr(0.20, 0.59), ar(0.25, 0.38), hr(0.25, 0.0);
  const Vec2 cl(0.25 + slit, 0.06), cu(0.36 + slit, 0.05);
  const auto m = [](const Vec2& p) { return Vec2(-p.x(), p.y()); };
  Drawn d = complete({{"neck_left", "neck_right", m(nr), bow(m(nr), nr, {0, 0.45})},
                      {"neck_right", "neck_left", nr, {}},
                      {"shoulder_right", "shoulder_left", sr, bow(sr, cu, {0.31, 0.5})},
                      {"cuff_upper_right", "cuff_upper_left", cu, {}},
                      {"cuff_lower_right", "cuff_lower_left", cl, {}},
                      {"armpit_right", "armpit_left", ar, {}},
                      {"hem_right", "hem_left", hr, {}},
                      {"hem_left", "hem_right", m(hr), {}},
                      {"armpit_left", "armpit_right", m(ar), {}},
                      {"cuff_lower_left", "cuff_lower_right", m(cl), {}},
                      {"cuff_upper_left", "cuff_upper_right", m(cu), bow(m(cu), m(sr), {-0.31, 0.5})},
                      {"shoulder_left", "shoulder_right", m(sr), {}}},
                     {{"neck", EdgeKind::neck},
                      {"shoulder_seam_right", EdgeKind::seam},
                      {"sleeve_upper_right", EdgeKind::seam},
                      {"cuff_right", EdgeKind::open},
                      {"sleeve_under_right", EdgeKind::seam},
                      {"side_right", EdgeKind::seam},
                      {"hem", EdgeKind::open},
                      {"side_left", EdgeKind::seam},
                      {"sleeve_under_left", EdgeKind::seam},
                      {"cuff_left", EdgeKind::open},
                      {"sleeve_upper_left", EdgeKind::seam},
                      {"shoulder_seam_left", EdgeKind::seam}});
  d.garment.scale = {index_of(d, "armpit_left"), index_of(d, "armpit_right"), "bust", 1.12,
                     index_of(d, "neck_left"),   index_of(d, "hem_left")};
  d.garment.anchors = {index_of(d, "neck_left"), index_of(d, "neck_right")};
  return d;
}

/// A crotch on the middle line, at which both legs' inside seams end; 1.02 m long, 0.27 m of it the rise.
inline Drawn trousers() {
  const Vec2 wr(0.20, 1.02), outer(0.27, 0.0), inner(0.05, -0.01), crotch(0, 0.75);
  const auto m = [](const Vec2& p) { return Vec2(-p.x(), p.y()); };
  Drawn d = complete({{"waist_left", "waist_right", m(wr), {}},
                      {"waist_right", "waist_left", wr, bow(wr, outer, {0.28, 0.80})},
                      {"hem_outer_right", "hem_outer_left", outer, {}},
                      {"hem_inner_right", "hem_inner_left", inner, {}},
                      {"crotch", "crotch", crotch, {}},
                      {"hem_inner_left", "hem_inner_right", m(inner), {}},
                      {"hem_outer_left", "hem_outer_right", m(outer), bow(m(outer), m(wr), {-0.28, 0.80})}},
                     {{"waist", EdgeKind::open},
                      {"side_right", EdgeKind::seam},
                      {"hem_right", EdgeKind::open},
                      {"inside_leg_right", EdgeKind::seam},
                      {"inside_leg_left", EdgeKind::seam},
                      {"hem_left", EdgeKind::open},
                      {"side_left", EdgeKind::seam}});
  d.garment.scale = {index_of(d, "waist_left"), index_of(d, "waist_right"),   "waist", 1.0,
                     index_of(d, "waist_left"), index_of(d, "hem_outer_left")};
  d.garment.anchors = {index_of(d, "waist_left"), index_of(d, "waist_right"), index_of(d, "crotch")};
  return d;
}

struct Shot {
  double pixels_per_metre = 1200, tilt_deg = 0, width = 1;  ///< width stretches x
  Vec2 centre{640, 900};
};

/// The features a perfect matcher would find on a photo of the drawing.
inline Features photograph(const Drawn& d, const Shot& shot = {}) {
  const double c = std::cos(shot.tilt_deg * std::numbers::pi / 180),
               s = std::sin(shot.tilt_deg * std::numbers::pi / 180);
  const auto pixel = [&](const Vec2& p) {
    const Vec2 q(p.x() * shot.width * shot.pixels_per_metre, -p.y() * shot.pixels_per_metre);
    return Vec2(shot.centre + Vec2(c * q.x() - s * q.y(), s * q.x() + c * q.y()));
  };
  const auto rounded = [](const Vec2& q) { return Vec2(std::round(q.x()), std::round(q.y())); };
  Features f;
  f.tilt_deg = shot.tilt_deg;
  const std::size_t n = d.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<Vec2> path{pixel(d.corners[i].metres)};
    for (const Vec2& p : d.corners[i].towards) path.push_back(pixel(p));
    path.push_back(pixel(d.corners[(i + 1) % n].metres));
    FeaturePoint point{d.corners[i].name, "", rounded(path[0]), "candidate", 1, static_cast<int>(f.contour.size())};
    f.points.push_back(point);
    f.contour.push_back(point.pixel);
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      const int steps = std::max(1, static_cast<int>((path[k + 1] - path[k]).norm()));
      for (int j = 1; j <= steps; ++j) {
        const Vec2 q = rounded(path[k] + (path[k + 1] - path[k]) * (static_cast<double>(j) / steps));
        if (q != f.contour.back()) f.contour.push_back(q);
      }
    }
    if (f.contour.back() == rounded(path.back())) f.contour.pop_back();
  }
  return f;
}

}  // namespace vitrine::test
