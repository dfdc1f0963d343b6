// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The shipped tables as engine templates. The host's adoption does this with checks; here the tables are our own, and
// the test of a room must not depend on the host.
#include <string>

#include "vitrine/model/garment_template.hpp"
#include "vitrine/templates/necklines.hpp"
#include "vitrine/templates/skirt.hpp"
#include "vitrine/templates/sleeve.hpp"
#include "vitrine/templates/torso.hpp"

namespace vitrine::test {

inline int feature_named(const GarmentTemplate& garment, const char* name) {
  for (std::size_t i = 0; name && i < garment.features.size(); ++i)
    if (garment.features[i].name == name) return static_cast<int>(i);
  return -1;
}

inline GarmentTemplate garment_of(const vitrine_garment& table) {
  GarmentTemplate garment;
  garment.id = table.id;
  garment.plugin = "test";
  for (std::uint32_t i = 0; i < table.features.count; ++i) {
    const vitrine_feature& f = table.features.data[i];
    garment.features.push_back({f.name, f.landmark ? f.landmark : "", -1, static_cast<Turn>(f.turn)});
  }
  for (std::uint32_t i = 0; i < table.features.count; ++i)
    garment.features[i].mirror = feature_named(garment, table.features.data[i].mirror);
  for (std::uint32_t i = 0; i < table.poses.count; ++i) {
    const vitrine_pose& p = table.poses.data[i];
    TemplatePose pose;
    pose.name = p.name;
    pose.uv.assign(garment.features.size(), Vec2::Zero());
    pose.radius.assign(garment.features.size(), 0);
    for (std::uint32_t k = 0; k < p.points.count; ++k) {
      const int f = feature_named(garment, p.points.data[k].feature);
      pose.uv[f] = Vec2(p.points.data[k].u, p.points.data[k].v);
      pose.radius[f] = p.points.data[k].radius;
    }
    garment.poses.push_back(std::move(pose));
  }
  for (std::uint32_t i = 0; i < table.edges.count; ++i) {
    const vitrine_edge& e = table.edges.data[i];
    const EdgeKind kind = e.kind == VITRINE_EDGE_SEAM   ? EdgeKind::seam
                          : e.kind == VITRINE_EDGE_OPEN ? EdgeKind::open
                                                        : EdgeKind::neck;
    garment.edges.push_back({e.name, feature_named(garment, e.from), feature_named(garment, e.to), kind});
  }
  for (std::uint32_t i = 0; i < table.limbs.count; ++i) {
    const vitrine_limb& l = table.limbs.data[i];
    garment.limbs.push_back({l.name,
                             feature_named(garment, l.root_a),
                             feature_named(garment, l.root_b),
                             feature_named(garment, l.tip_a),
                             feature_named(garment, l.tip_b),
                             {}});
    for (std::uint32_t k = 0; k < l.chain.count; ++k) garment.limbs.back().chain.push_back(l.chain.data[k].name);
  }
  if (table.scale.count > 0) {
    const vitrine_scale_rule& r = table.scale.data[0];
    garment.scale = {feature_named(garment, r.feature_a), feature_named(garment, r.feature_b), r.girth, r.ease,
                     feature_named(garment, r.top),       feature_named(garment, r.bottom)};
  }
  return garment;
}

inline NecklineTemplate neckline_of(const vitrine_neckline& table) {
  NecklineTemplate neckline;
  neckline.id = table.id;
  neckline.plugin = "test";
  for (std::uint32_t i = 0; i < table.profile.count; ++i)
    neckline.profile.emplace_back(table.profile.data[i].s, table.profile.data[i].depth);
  neckline.ratio_min = table.ratio_min;
  neckline.ratio_max = table.ratio_max;
  neckline.default_depth = table.default_depth;
  return neckline;
}

inline std::vector<NecklineTemplate> necklines() {
  return {neckline_of(templates::neck_u), neckline_of(templates::neck_v), neckline_of(templates::neck_square)};
}

}  // namespace vitrine::test
