// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "vitrine/features.hpp"

namespace vitrine::test {

/// Outlines in a 400 x 500 field, clockwise, with the corner names at some of their points.
struct Drawing {
  std::vector<Vec2> outline;
  std::vector<std::pair<std::string, Vec2>> corners;
};

inline GarmentTemplate garment(const std::string& id, const std::vector<TemplateFeature>& features,
                               const std::vector<TemplateEdge>& edges, const std::vector<Vec2>& uv, double radius) {
  GarmentTemplate g;
  g.id = id;
  g.plugin = "test." + id;
  g.features = features;
  g.edges = edges;
  g.poses.push_back({"flat", uv, std::vector<double>(uv.size(), radius)});
  return g;
}

inline GarmentTemplate vest() {
  return garment(
      "vest",
      {{"neck_left", "", 1, Turn::convex},
       {"neck_right", "", 0, Turn::convex},
       {"shoulder_right", "", 7, Turn::convex},
       {"armpit_right", "", 6, Turn::convex},
       {"hem_right", "", 5, Turn::convex},
       {"hem_left", "", 4, Turn::convex},
       {"armpit_left", "", 3, Turn::convex},
       {"shoulder_left", "", 2, Turn::convex}},
      {{"neck", 0, 1, EdgeKind::neck},
       {"shoulder_seam_right", 1, 2, EdgeKind::seam},
       {"armhole_right", 2, 3, EdgeKind::open},
       {"side_right", 3, 4, EdgeKind::seam},
       {"hem", 4, 5, EdgeKind::open},
       {"side_left", 5, 6, EdgeKind::seam},
       {"armhole_left", 6, 7, EdgeKind::open},
       {"shoulder_seam_left", 7, 0, EdgeKind::seam}},
      {{0.3, 0.01}, {0.7, 0.01}, {0.84, 0.03}, {0.97, 0.34}, {0.99, 0.98}, {0.01, 0.98}, {0.03, 0.34}, {0.16, 0.03}},
      0.12);
}

inline GarmentTemplate skirt() {
  return garment("skirt",
                 {{"waist_left", "", 1, Turn::convex},
                  {"waist_right", "", 0, Turn::convex},
                  {"hem_right", "", 3, Turn::convex},
                  {"hem_left", "", 2, Turn::convex}},
                 {{"waist", 0, 1, EdgeKind::open},
                  {"side_right", 1, 2, EdgeKind::seam},
                  {"hem", 2, 3, EdgeKind::open},
                  {"side_left", 3, 0, EdgeKind::seam}},
                 {{0.15, 0.01}, {0.85, 0.01}, {0.99, 0.97}, {0.01, 0.97}}, 0.12);
}

inline GarmentTemplate long_sleeve() {
  GarmentTemplate g = garment("long_sleeve",
                              {{"neck_left", "", 1, Turn::convex},
                               {"neck_right", "", 0, Turn::convex},
                               {"shoulder_right", "", 11, Turn::any},
                               {"cuff_upper_right", "", 10, Turn::convex},
                               {"cuff_lower_right", "", 9, Turn::convex},
                               {"armpit_right", "", 8, Turn::concave},
                               {"hem_right", "", 7, Turn::convex},
                               {"hem_left", "", 6, Turn::convex},
                               {"armpit_left", "", 5, Turn::concave},
                               {"cuff_lower_left", "", 4, Turn::convex},
                               {"cuff_upper_left", "", 3, Turn::convex},
                               {"shoulder_left", "", 2, Turn::any}},
                              {},
                              {{0.4, 0},
                               {0.6, 0},
                               {0.76, 0.08},
                               {0.96, 0.9},
                               {0.86, 0.92},
                               {0.77, 0.37},
                               {0.76, 0.99},
                               {0.24, 0.99},
                               {0.23, 0.37},
                               {0.14, 0.92},
                               {0.04, 0.9},
                               {0.24, 0.08}},
                              0.12);
  const char* names[] = {
      "neck", "shoulder_seam_right", "sleeve_upper_right", "cuff_right", "under_right",       "side_right",
      "hem",  "side_left",           "under_left",         "cuff_left",  "sleeve_upper_left", "shoulder_seam_left"};
  const EdgeKind s = EdgeKind::seam, o = EdgeKind::open;
  const EdgeKind kinds[] = {EdgeKind::neck, s, s, o, s, s, o, s, s, o, s, s};
  for (int i = 0; i < 12; ++i) g.edges.push_back({names[i], i, (i + 1) % 12, kinds[i]});
  g.limbs = {{"sleeve_right", 2, 5, 3, 4, {}}, {"sleeve_left", 11, 8, 10, 9, {}}};
  return g;
}

inline GarmentTemplate trousers() {
  GarmentTemplate g =
      garment("trousers",
              {{"waist_left", "waist_left", 1, Turn::convex},
               {"waist_right", "waist_right", 0, Turn::convex},
               {"hem_outer_right", "ankle_right", 6, Turn::convex},
               {"hem_inner_right", "ankle_right", 5, Turn::convex},
               {"crotch", "crotch", 4, Turn::concave},
               {"hem_inner_left", "ankle_left", 3, Turn::convex},
               {"hem_outer_left", "ankle_left", 2, Turn::convex}},
              {}, {{0.2, 0.01}, {0.8, 0.01}, {0.98, 0.98}, {0.6, 0.99}, {0.5, 0.32}, {0.4, 0.99}, {0.02, 0.98}}, 0.15);
  const char* names[] = {"waist", "side_right", "hem_right", "inside_right", "inside_left", "hem_left", "side_left"};
  const EdgeKind s = EdgeKind::seam, o = EdgeKind::open, kinds[] = {o, s, o, s, s, o, s};
  for (int i = 0; i < 7; ++i) g.edges.push_back({names[i], i, (i + 1) % 7, kinds[i]});
  g.limbs = {{"leg_right", 1, 4, 2, 3, {"thigh_right", "knee_right", "ankle_right"}},
             {"leg_left", 0, 4, 6, 5, {"thigh_left", "knee_left", "ankle_left"}}};
  g.scale = {0, 1, "waist", 1.0, 0, 6};
  return g;
}

inline NecklineTemplate neckline(const std::string& id, double low, double high,
                                 const std::function<double(double)>& depth) {
  NecklineTemplate n;
  n.id = id;
  n.plugin = "test." + id;
  n.ratio_min = low;
  n.ratio_max = high;
  for (int i = 0; i <= 100; ++i) n.profile.emplace_back(i / 100.0, depth(i / 100.0));
  return n;
}
inline double v_depth(double s) {
  return 1 - std::abs(2 * s - 1);
}
inline double u_depth(double s) {
  return std::sqrt(std::max(0.0, 1 - (2 * s - 1) * (2 * s - 1)));
}
inline double square_depth(double s) {
  return s <= 0 || s >= 1 ? 0 : 1;
}
inline std::vector<NecklineTemplate> necklines() {
  return {neckline("neck_u", 0.12, 0.5, u_depth), neckline("neck_v", 0.5, 100, v_depth),
          neckline("neck_square", 0, 0.12, square_depth)};
}

inline void add_neck(Drawing& d, const Vec2& left, const Vec2& right, double depth,
                     const std::function<double(double)>& shape) {
  for (int i = 0; i <= 200; ++i) {
    const double s = i / 200.0;
    d.outline.push_back(left + s * (right - left) + Vec2(0, depth * shape(s)));
  }
}

inline Drawing draw_vest(double depth = 70, const std::function<double(double)>& shape = u_depth) {
  Drawing d;
  const Vec2 nl(150, 60), nr(250, 60), sr(290, 68), ar(330, 190), hr(335, 440), hl(65, 440), al(70, 190), sl(110, 68);
  add_neck(d, nl, nr, depth, shape);
  d.outline.insert(d.outline.end(),
                   {sr, {288, 110}, {298, 160}, {312, 180}, ar, hr, hl, al, {88, 180}, {102, 160}, {112, 110}, sl});
  d.corners = {{"neck_left", nl}, {"neck_right", nr}, {"shoulder_right", sr}, {"armpit_right", ar},
               {"hem_right", hr}, {"hem_left", hl},   {"armpit_left", al},    {"shoulder_left", sl}};
  return d;
}

inline Drawing draw_skirt() {
  Drawing d;
  d.outline = {{130, 80}, {270, 80}, {340, 400}, {60, 400}};
  d.corners = {
      {"waist_left", {130, 80}}, {"waist_right", {270, 80}}, {"hem_right", {340, 400}}, {"hem_left", {60, 400}}};
  return d;
}

/// Trousers with a rise of 110, whose hems are `gap` apart; `notch`: height where the ground between the legs begins.
inline Drawing draw_trousers(double gap, double notch = 240) {
  Drawing d;
  const Vec2 wl(130, 130), wr(270, 130), hor(300 + gap / 4, 460), hir(200 + gap / 2, 464);
  const auto m = [](const Vec2& p) { return Vec2(400 - p.x(), p.y()); };
  d.outline = {wl, wr, hor, hir, {200, notch}, m(hir), m(hor)};
  d.corners = {{"waist_left", wl},        {"waist_right", wr},      {"hem_outer_right", hor},
               {"hem_inner_right", hir},  {"crotch", {200, notch}}, {"hem_inner_left", m(hir)},
               {"hem_outer_left", m(hor)}};
  return d;
}

inline Drawing draw_long_sleeve() {
  Drawing d;
  const Vec2 nl(165, 60), nr(235, 60);
  add_neck(d, nl, nr, 20, u_depth);
  d.outline.insert(d.outline.end(), {{290, 85},
                                     {365, 400},
                                     {330, 410},
                                     {292, 200},
                                     {290, 440},
                                     {110, 440},
                                     {108, 200},
                                     {70, 410},
                                     {35, 400},
                                     {110, 85}});
  d.corners = {{"neck_left", nl},
               {"neck_right", nr},
               {"cuff_upper_right", {365, 400}},
               {"cuff_lower_right", {330, 410}},
               {"armpit_right", {292, 200}},
               {"hem_right", {290, 440}},
               {"hem_left", {110, 440}},
               {"armpit_left", {108, 200}},
               {"cuff_lower_left", {70, 410}},
               {"cuff_upper_left", {35, 400}}};
  return d;
}

inline Drawing turned(Drawing d, double degrees) {
  const double a = degrees * std::numbers::pi / 180;
  const auto turn = [&](const Vec2& p) {
    const Vec2 q = p - Vec2(200, 250);
    return Vec2(200 + std::cos(a) * q.x() - std::sin(a) * q.y(), 250 + std::sin(a) * q.x() + std::cos(a) * q.y());
  };
  for (Vec2& p : d.outline) p = turn(p);
  for (auto& [name, p] : d.corners) p = turn(p);
  return d;
}

/// Fills the outline by the even-odd rule into a label image of 400 x 500, moved by (40, 20) so that a turned one fits.
inline Image filled(const std::vector<Vec2>& outline, int width = 480, int height = 540) {
  Image labels(width, height, 1);
  for (int y = 0; y < height; ++y) {
    std::vector<double> cuts;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2 a = outline[i] + Vec2(40, 20), b = outline[(i + 1) % outline.size()] + Vec2(40, 20);
      if ((a.y() <= y) != (b.y() <= y)) cuts.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); k += 2)
      for (int x = std::max(0, static_cast<int>(std::ceil(cuts[k]))); x <= cuts[k + 1] && x < width; ++x)
        *labels.at(x, y) = label_outside;
  }
  return labels;
}

inline Image mirrored(const Image& image) {
  Image result = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < image.channels; ++c) result.at(x, y)[c] = image.at(image.width - 1 - x, y)[c];
  return result;
}

inline Result<Features> features_of(const Image& labels, const GarmentTemplate& garment, FeatureOptions options = {}) {
  Photo photo;
  photo.path = "drawn.png";
  photo.rgb = Image(labels.width, labels.height, 3, 90);
  Silhouette silhouette;
  silhouette.labels = labels;
  return find_features(photo, silhouette, garment, necklines(), options);
}

inline const FeaturePoint& point(const Features& features, const std::string& name) {
  return *std::find_if(features.points.begin(), features.points.end(), [&](const auto& p) { return p.name == name; });
}

}  // namespace vitrine::test
