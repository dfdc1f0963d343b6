// SPDX-License-Identifier: MIT
#pragma once
// The host's structural rules, checked by the author's own compiler:
//
//   VITRINE_CHECK(my_garment);                         // or a neckline, anything constexpr
//   static_assert(vitrine::sdk::check(my_garment));    // the same without a macro
//
// When a rule is broken the compiler stops with a sentence: the rule's name (docs/ABI.md lists them), what it asks for,
// and the table, the row and the name at fault. static_assert gives the sentence too, but g++ then leaves out the name.
// The host checks again when it adopts the plugin; this only brings the answer forward.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "vitrine/abi.h"
#include "vitrine/plugin.hpp"

namespace vitrine::sdk {

/// Landmarks and girths of the body that a table may refer to (docs/ABI.md).
inline constexpr const char* body_landmarks[] = {
    "neck_left",    "neck_right",  "neck_front", "neck_back",   "shoulder_left", "shoulder_right", "armpit_left",
    "armpit_right", "bust_left",   "bust_right", "under_bust",  "waist",         "waist_left",     "waist_right",
    "hip",          "hip_left",    "hip_right",  "biceps_left", "biceps_right",  "elbow_left",     "elbow_right",
    "wrist_left",   "wrist_right", "crotch",     "thigh_left",  "thigh_right",   "knee_left",      "knee_right",
    "ankle_left",   "ankle_right", "crown"};
inline constexpr const char* body_girths[] = {"bust",      "under_bust", "waist", "hip",
                                              "neck_base", "biceps",     "wrist", "thigh"};

namespace detail {

/// Where in a garment or neckline: a table, a row of it counted from 0, and the name that stands there.
struct Row {
  const char* table;
  std::size_t row;
  const char* name;
};

/// Ends the compile where a rule is broken: the compiler prints this call with its sentence.
struct Stop {
  constexpr bool operator()(bool holds, const char* sentence, const char* /*table*/, std::size_t /*row*/,
                            const char* /*name*/) const {
    if (!holds) throw sentence;
    return true;
  }
};

/// Keeps the first broken rule as text, empty when all hold. Its members are public so that it can be a template's
/// argument, which g++ prints in full.
struct Sentence {
  char text[320] = {};
  std::size_t length = 0;

  constexpr void add(std::string_view part) {
    for (std::size_t i = 0; i < part.size() && length + 1 < sizeof text; ++i) text[length++] = part[i];
  }
  constexpr bool operator()(bool holds, const char* sentence, const char* table, std::size_t row, const char* name) {
    if (holds || length > 0) return holds;
    add(sentence);
    add(" -- ");
    add(table);
    char digits[20] = {};
    std::size_t n = 0;
    do digits[n++] = static_cast<char>('0' + row % 10);
    while ((row /= 10) > 0);
    add("[");
    while (n > 0) add({&digits[--n], 1});
    add("] ");
    add(name == nullptr ? "(no name)" : name);
    return false;
  }
};

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

template <std::size_t n>
constexpr bool among(const char* const (&names)[n], const char* name) {
  for (const char* known : names)
    if (name != nullptr && same(known, name)) return true;
  return false;
}

constexpr bool inside(double value, double least, double most) {
  return value >= least && value <= most;  // NaN: no
}
constexpr double distance_squared(const vitrine_pose_point& a, const vitrine_pose_point& b) {
  return (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v);
}

constexpr bool well_formed(const char* name) {
  if (name == nullptr || name[0] < 'a' || name[0] > 'z') return false;
  std::size_t length = 0;
  for (const char* c = name; *c != '\0'; ++c, ++length)
    if (!((*c >= 'a' && *c <= 'z') || (*c >= '0' && *c <= '9') || *c == '_')) return false;
  return length <= 64;
}
constexpr bool titled(const char* title) {
  return title != nullptr && title[0] != '\0' && std::string_view(title).size() <= 200;
}

template <class Span, class Report>
constexpr bool names_keep(const Span& table, const char* kind, Report& report) {
  for (std::uint32_t i = 0; i < table.count; ++i) {
    const char* name = table.data[i].name;
    if (!report(well_formed(name), "name.form: a name is small letters, digits and _, and begins with a letter", kind,
                i, name) ||
        !report(find(table, name) == static_cast<int>(i), "name.unique: no two rows of a table have the same name",
                kind, i, name))
      return false;
  }
  return true;
}

template <class Report>
constexpr bool sizes_keep(const vitrine_garment& g, Report& report) {
  const char* sentence = "span.count: a table has fewer or more rows than the ABI allows";
  const struct {
    const char* table;
    std::uint32_t count, least, most;
  } sizes[] = {{"features", g.features.count, 3, 64}, {"edges", g.edges.count, 3, 64},
               {"poses", g.poses.count, 1, 16},       {"seams", g.seams.count, 1, 64},
               {"limbs", g.limbs.count, 0, 8},        {"scale", g.scale.count, 1, 1},
               {"anchors", g.anchors.count, 1, 16},   {"fabrics", g.fabrics.count, 1, 32}};
  for (const auto& size : sizes)
    if (!report(size.count >= size.least && size.count <= size.most, sentence, size.table, size.count, "rows"))
      return false;
  return true;
}

template <class Report>
constexpr bool features_keep(const vitrine_garment& g, Report& report) {
  for (std::uint32_t i = 0; i < g.features.count; ++i) {
    const vitrine_feature& f = g.features.data[i];
    if (!report(f.landmark == nullptr || f.landmark[0] == '\0' || among(body_landmarks, f.landmark),
                "name.known: the landmark of a feature is none that a body has", "features", i, f.landmark) ||
        !report(f.turn >= VITRINE_TURN_CONCAVE && f.turn <= VITRINE_TURN_CONVEX && f.reserved == 0,
                "number.range: turn is VITRINE_TURN_..., reserved is 0", "features", i, f.name))
      return false;
    if (f.mirror == nullptr) continue;
    const int partner = find(g.features, f.mirror);
    if (!report(partner >= 0, "name.known: the mirror of a feature is no feature of this garment", "features", i,
                f.mirror) ||
        !report(same(g.features.data[partner].mirror, f.name),
                "mirror.involution: a feature has to be the mirror of its mirror", "features", i, f.name))
      return false;
  }
  return true;
}

template <class Report>
constexpr bool outline_keeps(const vitrine_garment& g, Report& report) {
  const auto count = static_cast<int>(g.features.count);
  int walked = 0, necks = 0;
  for (std::uint32_t i = 0; i < g.edges.count; ++i) {
    const vitrine_edge &edge = g.edges.data[i], &next = g.edges.data[(i + 1) % g.edges.count];
    const int from = find(g.features, edge.from), to = find(g.features, edge.to);
    if (!report(from >= 0 && to >= 0, "name.known: an edge begins or ends at a feature that this garment does not have",
                "edges", i, edge.name) ||
        !report(
            same(edge.to, next.from),
            "outline.closed: the panel is open: each edge has to begin where the one before it ends, and the last to "
            "end where the first began",
            "edges", i, edge.name) ||
        !report(edge.kind <= VITRINE_EDGE_NECK && edge.reserved == 0,
                "number.range: kind is VITRINE_EDGE_..., reserved is 0", "edges", i, edge.name) ||
        !report((necks += edge.kind == VITRINE_EDGE_NECK) <= 1, "outline.neck: a garment has at most one neck edge",
                "edges", i, edge.name))
      return false;
    const int step = (to - from + count) % count;
    walked += step == 0 ? count : step;
  }
  return report(walked == count,
                "outline.order: the edges have to visit the features once, in the order of their table (clockwise)",
                "edges", 0, g.edges.data[0].name);
}

constexpr int seams_of(const vitrine_garment& g, const char* edge, std::uint32_t side) {
  int uses = 0;
  for (const vitrine_seam& seam : rows(g.seams)) {
    uses += seam.side_a == side && same(seam.edge_a, edge);
    uses += seam.side_b == side && same(seam.edge_b, edge);
  }
  return uses;
}

template <class Report>
constexpr bool seams_keep(const vitrine_garment& g, Report& report) {
  for (std::uint32_t i = 0; i < g.seams.count; ++i) {
    const vitrine_seam& seam = g.seams.data[i];
    for (const char* name : {seam.edge_a, seam.edge_b}) {
      const int edge = find(g.edges, name);
      if (!report(edge >= 0, "name.known: a seam sews an edge that this garment does not have", "seams", i, name) ||
          !report(g.edges.data[edge].kind == VITRINE_EDGE_SEAM, "seam.kind: a seam sews edges of kind SEAM only",
                  "seams", i, name))
        return false;
    }
    if (!report(seam.side_a <= VITRINE_SIDE_BACK && seam.side_b <= VITRINE_SIDE_BACK && seam.reversed <= 1 &&
                    seam.reserved == 0,
                "number.range: a side is VITRINE_SIDE_..., reversed is 0 or 1, reserved is 0", "seams", i, seam.edge_a))
      return false;
  }
  for (std::uint32_t i = 0; i < g.edges.count; ++i)
    for (const std::uint32_t side : {VITRINE_SIDE_FRONT, VITRINE_SIDE_BACK})
      if (g.edges.data[i].kind == VITRINE_EDGE_SEAM &&
          !report(seams_of(g, g.edges.data[i].name, side) == 1,
                  "seam.pairs: an edge of kind SEAM has to be sewn exactly once on the front and once on the back",
                  "edges", i, g.edges.data[i].name))
        return false;
  return true;
}

/// The place of a feature in a pose; the pose has one.
constexpr const vitrine_pose_point& place(const vitrine_pose& pose, const char* feature) {
  for (const vitrine_pose_point& point : rows(pose.points))
    if (same(point.feature, feature)) return point;
  return pose.points.data[0];
}

template <class Report>
constexpr bool poses_keep(const vitrine_garment& g, Report& report) {
  for (std::uint32_t p = 0; p < g.poses.count; ++p) {
    const vitrine_pose& pose = g.poses.data[p];
    for (const vitrine_pose_point& point : rows(pose.points))
      if (!report(find(g.features, point.feature) >= 0,
                  "name.known: a pose places a feature that this garment does not have", "poses", p, point.feature) ||
          !report(inside(point.u, 0, 1) && inside(point.v, 0, 1) && inside(point.radius, 1e-3, 0.5),
                  "number.range: u and v lie in 0 to 1, a search radius in 0.001 to 0.5", "poses", p, point.feature))
        return false;
    for (const vitrine_feature& feature : rows(g.features)) {
      int places = 0;
      for (const vitrine_pose_point& point : rows(pose.points)) places += same(point.feature, feature.name);
      if (!report(places == 1, "pose.complete: a pose has to place every feature exactly once", "poses", p,
                  feature.name))
        return false;
    }
    double area = 0;  // [box areas], positive when clockwise in a picture, whose v grows downwards
    for (const vitrine_edge& edge : rows(g.edges)) {
      const vitrine_pose_point &a = place(pose, edge.from), &b = place(pose, edge.to);
      area += 0.5 * (a.u * b.v - b.u * a.v);
    }
    if (!report(area > 0.01, "pose.clockwise: the outline of a pose has to run clockwise in the picture", "poses", p,
                pose.name))
      return false;
  }
  return true;
}

template <class Report>
constexpr bool limbs_keep(const vitrine_garment& g, Report& report) {
  for (std::uint32_t i = 0; i < g.limbs.count; ++i) {
    const vitrine_limb& limb = g.limbs.data[i];
    const char* corners[] = {limb.root_a, limb.root_b, limb.tip_a, limb.tip_b};
    for (int a = 0; a < 4; ++a) {
      if (!report(find(g.features, corners[a]) >= 0,
                  "name.known: a limb begins or ends at a feature that this garment does not have", "limbs", i,
                  corners[a]))
        return false;
      for (int b = 0; b < a; ++b)
        if (!report(!same(corners[a], corners[b]), "limb.corners: root and tip of a limb are four different features",
                    "limbs", i, limb.name))
          return false;
    }
    if (!report(limb.chain.count >= 2 && limb.chain.count <= 8,
                "span.count: the chain of a limb has 2 to 8 landmarks of the body", "limbs", i, limb.name))
      return false;
    for (const vitrine_name& landmark : rows(limb.chain))
      if (!report(among(body_landmarks, landmark.name),
                  "name.known: the chain of a limb names a landmark that no body has", "limbs", i, landmark.name))
        return false;
  }
  return true;
}

template <class Report>
constexpr bool scale_keeps(const vitrine_garment& g, Report& report) {
  const vitrine_scale_rule& scale = g.scale.data[0];
  for (const char* name : {scale.feature_a, scale.feature_b, scale.top, scale.bottom})
    if (!report(find(g.features, name) >= 0,
                "name.known: the scale rule measures at a feature that this garment does not have", "scale", 0, name))
      return false;
  if (!report(among(body_girths, scale.girth), "name.known: the scale rule names a girth that no body has", "scale", 0,
              scale.girth) ||
      !report(inside(scale.ease, 0.3, 4), "number.range: ease lies in 0.3 to 4", "scale", 0, scale.girth))
    return false;
  for (const vitrine_pose& pose : rows(g.poses))
    if (!report(
            distance_squared(place(pose, scale.feature_a), place(pose, scale.feature_b)) > 1e-4 &&
                place(pose, scale.bottom).v - place(pose, scale.top).v > 0.01,
            "scale.measurable: the features that the scale rule measures lie apart, top above bottom, in every pose",
            "scale", 0, pose.name))
      return false;
  for (std::uint32_t i = 0; i < g.anchors.count; ++i) {
    const int anchor = find(g.features, g.anchors.data[i].name);
    if (!report(anchor >= 0, "name.known: an anchor is a feature that this garment does not have", "anchors", i,
                g.anchors.data[i].name) ||
        !report(among(body_landmarks, g.features.data[anchor].landmark),
                "anchor.landmark: an anchor needs a body landmark to hang on", "anchors", i, g.anchors.data[i].name))
      return false;
  }
  return true;
}

template <class Report>
constexpr bool fabrics_keep(const vitrine_garment& g, Report& report) {
  for (std::uint32_t i = 0; i < g.fabrics.count; ++i) {
    const vitrine_fabric& f = g.fabrics.data[i];
    if (!report(inside(f.stretch, 1, 1e7) && inside(f.shear, 0, 1e7) && inside(f.bend, 0, 1) &&
                    inside(f.mass, 0.01, 5) && inside(f.friction, 0, 5),
                "number.range: stretch is 1 to 1e7 N/m, shear 0 to 1e7 N/m, bend 0 to 1 N m, mass 0.01 to 5 kg/m2, "
                "friction 0 to 5",
                "fabrics", i, f.name))
      return false;
  }
  return true;
}

template <class Report>
constexpr bool keeps(const vitrine_garment& g, Report& report) {
  return report(well_formed(g.id), "name.form: the id of a garment is small letters, digits and _", "id", 0, g.id) &&
         report(titled(g.title), "text.present: the garment has a title of at most 200 bytes", "title", 0, g.title) &&
         sizes_keep(g, report) && names_keep(g.features, "features", report) && features_keep(g, report) &&
         names_keep(g.edges, "edges", report) && outline_keeps(g, report) && names_keep(g.poses, "poses", report) &&
         poses_keep(g, report) && seams_keep(g, report) && names_keep(g.limbs, "limbs", report) &&
         limbs_keep(g, report) && scale_keeps(g, report) && names_keep(g.fabrics, "fabrics", report) &&
         fabrics_keep(g, report);
}

template <class Report>
constexpr bool keeps(const vitrine_neckline& n, Report& report) {
  if (!report(well_formed(n.id), "name.form: the id of a neckline is small letters, digits and _", "id", 0, n.id) ||
      !report(titled(n.title), "text.present: the neckline has a title of at most 200 bytes", "title", 0, n.title) ||
      !report(n.profile.count >= 3 && n.profile.count <= 256, "span.count: a profile has 3 to 256 points", "profile",
              n.profile.count, "points"))
    return false;
  const auto profile = rows(n.profile);
  double deepest = 0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (!report(inside(profile[i].s, 0, 1) && inside(profile[i].depth, 0, 1), "number.range: s and depth lie in 0 to 1",
                "profile", i, n.id) ||
        !report(i == 0 || profile[i].s > profile[i - 1].s, "neckline.profile: s has to ascend", "profile", i, n.id))
      return false;
    if (profile[i].depth > deepest) deepest = profile[i].depth;
  }
  return report(!(profile.front().s > 0) && !(profile.front().depth > 0) && !(profile.back().s < 1) &&
                    !(profile.back().depth > 0) && !(deepest < 1),
                "neckline.profile: a profile runs from (0,0) to (1,0) and reaches depth 1", "profile", 0, n.id) &&
         report(inside(n.ratio_min, 0, 1e6) && inside(n.ratio_max, 0, 1e6) && n.ratio_min < n.ratio_max,
                "number.range: ratio_min lies below ratio_max, both in 0 to 1e6", "ratio", 0, n.id) &&
         report(inside(n.default_depth, 0.01, 5), "number.range: default_depth lies in 0.01 to 5", "default_depth", 0,
                n.id);
}

template <Sentence broken_rule>
struct Verdict {
  static_assert(broken_rule.length == 0,
                "this plugin breaks a rule of the ABI; \"Sentence\" above says which, and where");
  static constexpr bool sound = broken_rule.length == 0;
};

}  // namespace detail

/// The first rule that a garment (or a neckline) breaks, as text; empty when it keeps them all.
consteval detail::Sentence broken_rule(const auto& table) {
  detail::Sentence sentence;
  detail::keeps(table, sentence);
  return sentence;
}

/// True when the garment (or neckline) keeps every rule; does not compile, with a sentence, when it breaks one.
consteval bool check(const vitrine_garment& garment) {
  detail::Stop stop;
  return detail::keeps(garment, stop);
}
consteval bool check(const vitrine_neckline& neckline) {
  detail::Stop stop;
  return detail::keeps(neckline, stop);
}

}  // namespace vitrine::sdk

/// Use at namespace scope: VITRINE_CHECK(my_garment);
#if defined(__clang__)
// clang prints the arguments of the call that stopped it, but not text in a template's argument.
#define VITRINE_CHECK(...) static_assert(::vitrine::sdk::check(__VA_ARGS__))
#else
#define VITRINE_CHECK(...) \
  static_assert(::vitrine::sdk::detail::Verdict<::vitrine::sdk::broken_rule(__VA_ARGS__)>::sound)
#endif
