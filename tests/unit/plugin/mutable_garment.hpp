// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <deque>
#include <vector>

#include "vitrine/plugin.hpp"

namespace mutable_garment {

template <class Span>
auto rows(const Span& s) {
  return std::vector(s.data, s.data + s.count);
}
template <class T>
auto span(const std::vector<T>& v) {
  return typename vitrine::sdk::SpanOf<T>::Type{v.data(), static_cast<std::uint32_t>(v.size()),
                                                static_cast<std::uint32_t>(sizeof(T))};
}

}  // namespace mutable_garment

/// A garment table whose every row a test may change; everything else stays as in the sound original.
class MutableGarment {
 public:
  explicit MutableGarment(const vitrine_garment& original)
      : features(mutable_garment::rows(original.features)),
        edges(mutable_garment::rows(original.edges)),
        seams(mutable_garment::rows(original.seams)),
        poses(mutable_garment::rows(original.poses)),
        limbs(mutable_garment::rows(original.limbs)),
        scale(mutable_garment::rows(original.scale)),
        anchors(mutable_garment::rows(original.anchors)),
        fabrics(mutable_garment::rows(original.fabrics)),
        table(original) {
    for (const vitrine_pose& pose : poses) points.push_back(mutable_garment::rows(pose.points));
  }

  /// The table as a plugin would hand it over; valid as long as this object lives and is not changed again.
  const vitrine_garment& get() {
    for (std::size_t i = 0; i < poses.size() && i < points.size(); ++i)
      poses[i].points = mutable_garment::span(points[i]);
    table.features = mutable_garment::span(features);
    table.edges = mutable_garment::span(edges);
    table.seams = mutable_garment::span(seams);
    table.poses = mutable_garment::span(poses);
    table.limbs = mutable_garment::span(limbs);
    table.scale = mutable_garment::span(scale);
    table.anchors = mutable_garment::span(anchors);
    table.fabrics = mutable_garment::span(fabrics);
    return table;
  }

  std::vector<vitrine_feature> features;
  std::vector<vitrine_edge> edges;
  std::vector<vitrine_seam> seams;
  std::vector<vitrine_pose> poses;
  std::deque<std::vector<vitrine_pose_point>> points;
  std::vector<vitrine_limb> limbs;
  std::vector<vitrine_scale_rule> scale;
  std::vector<vitrine_name> anchors;
  std::vector<vitrine_fabric> fabrics;
  vitrine_garment table;
};
