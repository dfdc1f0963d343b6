// SPDX-License-Identifier: MIT
#pragma once
// The host's structural rules, checked by the author's own compiler: static_assert(vitrine::sdk::check(my_garment)).
// The host checks again when it adopts the plugin; this only brings the answer forward. When it fails, assert the
// single checks (outline_closed, seams_pair, ...) to see which one it is.
#include <cstddef>
#include <cstdint>
#include <span>

#include "vitrine/abi.h"
#include "vitrine/plugin.hpp"

namespace vitrine::sdk {

namespace detail {

template <class Span>
constexpr auto rows(const Span& span) {
  return std::span(span.data, span.count);
}

/// Index of the row of that name, -1 if there is none.
template <class Span>
constexpr int find(const Span& table, const char* name) {
  for (std::uint32_t i = 0; i < table.count; ++i)
    if (name != nullptr && same(table.data[i].name, name)) return static_cast<int>(i);
  return -1;
}

constexpr bool inside(double value, double least, double most) {
  return value >= least && value <= most;
}  // NaN: no

constexpr bool well_formed(const char* name) {
  if (name == nullptr || name[0] < 'a' || name[0] > 'z') return false;
  for (const char* c = name; *c != '\0'; ++c)
    if (!((*c >= 'a' && *c <= 'z') || (*c >= '0' && *c <= '9') || *c == '_')) return false;
  return true;
}

template <class Span>
constexpr bool names_unique(const Span& table) {
  for (std::uint32_t i = 0; i < table.count; ++i)
    if (!well_formed(table.data[i].name) || find(table, table.data[i].name) != static_cast<int>(i)) return false;
  return true;
}

constexpr bool sewn_once(const vitrine_garment& g, const char* edge, std::uint32_t side) {
  int uses = 0;
  for (const vitrine_seam& seam : rows(g.seams)) {
    uses += seam.side_a == side && same(seam.edge_a, edge);
    uses += seam.side_b == side && same(seam.edge_b, edge);
  }
  return uses == 1;
}

}  // namespace detail

/// Names are well formed, and unique in their table.
consteval bool names_unique(const vitrine_garment& g) {
  return detail::well_formed(g.id) && detail::names_unique(g.features) && detail::names_unique(g.edges) &&
         detail::names_unique(g.poses) && detail::names_unique(g.limbs) && detail::names_unique(g.fabrics);
}

/// The mirror of a feature's mirror is the feature.
consteval bool mirrors_are_involutions(const vitrine_garment& g) {
  for (const vitrine_feature& feature : detail::rows(g.features)) {
    if (feature.mirror == nullptr) continue;
    const int partner = detail::find(g.features, feature.mirror);
    if (partner < 0 || !same(g.features.data[partner].mirror, feature.name)) return false;
  }
  return true;
}

/// Edges join existing features end to end, and the last closes the outline.
consteval bool outline_closed(const vitrine_garment& g) {
  if (g.edges.count < 3) return false;
  for (std::uint32_t i = 0; i < g.edges.count; ++i) {
    const vitrine_edge& edge = g.edges.data[i];
    if (detail::find(g.features, edge.from) < 0 || detail::find(g.features, edge.to) < 0) return false;
    if (!same(edge.to, g.edges.data[(i + 1) % g.edges.count].from)) return false;
  }
  return true;
}

/// Walking the edges passes the features once, in the order of their table.
consteval bool outline_ordered(const vitrine_garment& g) {
  const int count = static_cast<int>(g.features.count);
  int walked = 0;
  for (const vitrine_edge& edge : detail::rows(g.edges)) {
    const int step = (detail::find(g.features, edge.to) - detail::find(g.features, edge.from) + count) % count;
    walked += step == 0 ? count : step;
  }
  return walked == count;
}

/// At most one neck edge.
consteval bool one_neck(const vitrine_garment& g) {
  int necks = 0;
  for (const vitrine_edge& edge : detail::rows(g.edges)) necks += edge.kind == VITRINE_EDGE_NECK;
  return necks <= 1;
}

/// Seams name existing edges, and those are of kind seam.
consteval bool seams_join_seam_edges(const vitrine_garment& g) {
  for (const vitrine_seam& seam : detail::rows(g.seams))
    for (const char* name : {seam.edge_a, seam.edge_b}) {
      const int edge = detail::find(g.edges, name);
      if (edge < 0 || g.edges.data[edge].kind != VITRINE_EDGE_SEAM) return false;
    }
  return true;
}

/// Every edge of kind seam is sewn exactly once on the front and once on the back.
consteval bool seams_pair(const vitrine_garment& g) {
  for (const vitrine_edge& edge : detail::rows(g.edges))
    for (const std::uint32_t side : {VITRINE_SIDE_FRONT, VITRINE_SIDE_BACK})
      if (edge.kind == VITRINE_EDGE_SEAM && !detail::sewn_once(g, edge.name, side)) return false;
  return true;
}

/// Every pose places every feature exactly once, inside the box.
consteval bool poses_complete(const vitrine_garment& g) {
  if (g.poses.count == 0) return false;
  for (const vitrine_pose& pose : detail::rows(g.poses)) {
    if (pose.points.count != g.features.count) return false;
    for (const vitrine_feature& feature : detail::rows(g.features)) {
      int places = 0;
      for (const vitrine_pose_point& point : detail::rows(pose.points)) places += same(point.feature, feature.name);
      if (places != 1) return false;
    }
    for (const vitrine_pose_point& point : detail::rows(pose.points))
      if (!detail::inside(point.u, 0, 1) || !detail::inside(point.v, 0, 1) || !detail::inside(point.radius, 1e-3, 0.5))
        return false;
  }
  return true;
}

/// Limbs, scale rule and anchors name existing features.
consteval bool references_exist(const vitrine_garment& g) {
  const auto feature = [&](const char* name) { return detail::find(g.features, name) >= 0; };
  for (const vitrine_limb& limb : detail::rows(g.limbs))
    if (!feature(limb.root_a) || !feature(limb.root_b) || !feature(limb.tip_a) || !feature(limb.tip_b)) return false;
  if (g.scale.count != 1) return false;
  const vitrine_scale_rule& scale = g.scale.data[0];
  if (!feature(scale.feature_a) || !feature(scale.feature_b) || !feature(scale.top) || !feature(scale.bottom))
    return false;
  for (const vitrine_name& anchor : detail::rows(g.anchors))
    if (!feature(anchor.name)) return false;
  return g.anchors.count > 0;
}

/// Fabrics lie in their ranges.
consteval bool fabrics_in_range(const vitrine_garment& g) {
  for (const vitrine_fabric& f : detail::rows(g.fabrics))
    if (!detail::inside(f.stretch, 1, 1e7) || !detail::inside(f.shear, 0, 1e7) || !detail::inside(f.bend, 0, 1) ||
        !detail::inside(f.mass, 0.01, 5) || !detail::inside(f.friction, 0, 5))
      return false;
  return g.fabrics.count > 0;
}

/// All of the above.
consteval bool check(const vitrine_garment& g) {
  return names_unique(g) && mirrors_are_involutions(g) && outline_closed(g) && outline_ordered(g) && one_neck(g) &&
         seams_join_seam_edges(g) && seams_pair(g) && poses_complete(g) && references_exist(g) && fabrics_in_range(g);
}

/// The profile runs from (0,0) to (1,0), s ascending, and reaches depth 1; the ratio range is not empty.
consteval bool check(const vitrine_neckline& n) {
  if (!detail::well_formed(n.id) || n.profile.count < 3) return false;
  const auto profile = detail::rows(n.profile);
  double deepest = 0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (!detail::inside(profile[i].s, 0, 1) || !detail::inside(profile[i].depth, 0, 1)) return false;
    if (i > 0 && !(profile[i].s > profile[i - 1].s)) return false;
    if (profile[i].depth > deepest) deepest = profile[i].depth;
  }
  const auto exactly = [](double value, double wanted) { return value >= wanted && value <= wanted; };
  return exactly(profile.front().s, 0) && exactly(profile.front().depth, 0) && exactly(profile.back().s, 1) &&
         exactly(profile.back().depth, 0) && exactly(deepest, 1) && n.ratio_min >= 0 && n.ratio_min < n.ratio_max &&
         detail::inside(n.default_depth, 0.01, 5);
}

}  // namespace vitrine::sdk
