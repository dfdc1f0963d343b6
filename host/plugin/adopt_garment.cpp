// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <set>

#include "adopt_tables.hpp"

namespace vitrine::adoption {

namespace {

/// Copies one garment part by part; later parts refer to earlier ones by index.
class GarmentCopy {
 public:
  GarmentCopy(const vitrine_garment& table, const PluginIdentity& identity) : table_(table) {
    copy_.id = read_name(table.id, "a garment's id");
    where_ = "garment " + in_quotes(copy_.id);
    copy_.title = read_text(table.title, 200, where_ + ": title");
    copy_.plugin = identity.id;
    copy_.version = identity.version;
    features();
    edges();
    poses();
    seams();
    limbs();
    scale();
    anchors();
    fabrics();
  }
  GarmentTemplate take() { return std::move(copy_); }

 private:
  void features() {
    const auto rows = read_span(table_.features, 3, 64, where_ + ": features");
    for (const vitrine_feature& row : rows) {
      TemplateFeature feature;
      feature.name = read_name(row.name, where_ + ": a feature's name");
      feature_names_.add(feature.name, where_);
      const std::string where = where_ + ": feature " + in_quotes(feature.name);
      if (row.landmark != nullptr && readable_bytes(row.landmark, 1, where + ": landmark") == 1 &&
          row.landmark[0] != '\0')
        feature.landmark =
            read_known(row.landmark, {body_landmarks().begin(), body_landmarks().end()}, where + ": landmark");
      if (row.turn < VITRINE_TURN_CONCAVE || row.turn > VITRINE_TURN_CONVEX)
        throw Broken{"number.range", where + ": turn is " + std::to_string(row.turn) + ", allowed is -1 to 1"};
      feature.turn = static_cast<Turn>(row.turn);
      expect_zero(row.reserved, where);
      copy_.features.push_back(std::move(feature));
    }
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows[i].mirror != nullptr)
        copy_.features[i].mirror =
            feature_names_.find(rows[i].mirror, where_ + ": mirror of feature " + in_quotes(copy_.features[i].name));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const int partner = copy_.features[i].mirror;
      if (partner >= 0 && copy_.features[partner].mirror != static_cast<int>(i))
        throw Broken{"mirror.involution", where_ + ": feature " + in_quotes(copy_.features[i].name) + " mirrors " +
                                              in_quotes(copy_.features[partner].name) +
                                              ", but not the other way round"};
    }
  }

  void edges() {
    int necks = 0;
    for (const vitrine_edge& row : read_span(table_.edges, 3, 64, where_ + ": edges")) {
      TemplateEdge edge;
      edge.name = read_name(row.name, where_ + ": an edge's name");
      edge_names_.add(edge.name, where_);
      const std::string where = where_ + ": edge " + in_quotes(edge.name);
      edge.from = feature_names_.find(row.from, where + ": from");
      edge.to = feature_names_.find(row.to, where + ": to");
      edge.kind = static_cast<EdgeKind>(read_choice(row.kind, VITRINE_EDGE_NECK, where + ": kind"));
      expect_zero(row.reserved, where);
      necks += edge.kind == EdgeKind::neck;
      copy_.edges.push_back(std::move(edge));
    }
    if (necks > 1) throw Broken{"outline.neck", where_ + " has " + std::to_string(necks) + " neck edges, allowed is 1"};
    const int count = static_cast<int>(copy_.features.size());
    int walked = 0;
    for (std::size_t i = 0; i < copy_.edges.size(); ++i) {
      const TemplateEdge& edge = copy_.edges[i];
      const TemplateEdge& next = copy_.edges[(i + 1) % copy_.edges.size()];
      if (edge.to != next.from)
        throw Broken{"outline.closed", where_ + ": edge " + in_quotes(edge.name) + " ends at " +
                                           in_quotes(copy_.features[edge.to].name) + ", but edge " +
                                           in_quotes(next.name) + " begins at " +
                                           in_quotes(copy_.features[next.from].name)};
      const int step = (edge.to - edge.from + count) % count;
      walked += step == 0 ? count : step;
    }
    // Once round exactly: the same corner twice, or features listed against the walk, would go round more often.
    if (walked != count)
      throw Broken{"outline.order", where_ + ": the edges do not visit the features once, in the order of their table"};
  }

  void poses() {
    Names names("pose");
    for (const vitrine_pose& row : read_span(table_.poses, 1, 16, where_ + ": poses")) {
      TemplatePose pose;
      pose.name = read_name(row.name, where_ + ": a pose's name");
      names.add(pose.name, where_);
      const std::string where = where_ + ": pose " + in_quotes(pose.name);
      pose.uv.resize(copy_.features.size());
      pose.radius.resize(copy_.features.size());
      std::set<int> seen;
      for (const vitrine_pose_point& point : read_span(row.points, 1, 64, where)) {
        const int i = feature_names_.find(point.feature, where);
        const std::string at = where + ": " + in_quotes(copy_.features[i].name);
        if (!seen.insert(i).second) throw Broken{"pose.complete", at + " has two points"};
        pose.uv[i] = {read_number(point.u, 0, 1, at + ": u"), read_number(point.v, 0, 1, at + ": v")};
        pose.radius[i] = read_number(point.radius, 1e-3, 0.5, at + ": radius");
      }
      for (std::size_t i = 0; i < copy_.features.size(); ++i)
        if (!seen.contains(static_cast<int>(i)))
          throw Broken{"pose.complete", where + " has no point for feature " + in_quotes(copy_.features[i].name)};
      double area = 0;  // [box areas], positive when clockwise in a picture, whose v grows downwards
      for (const TemplateEdge& edge : copy_.edges) {
        const Vec2 &a = pose.uv[edge.from], &b = pose.uv[edge.to];
        area += 0.5 * (a.x() * b.y() - b.x() * a.y());
      }
      if (!(area > 0.01))
        throw Broken{"pose.clockwise", where + ": its outline does not run clockwise in the picture around an area"};
      copy_.poses.push_back(std::move(pose));
    }
  }

  void seams() {
    std::map<std::pair<Side, int>, int> uses;
    for (const vitrine_seam& row : read_span(table_.seams, 1, 64, where_ + ": seams")) {
      const std::string where = where_ + ": seam " + std::to_string(copy_.seams.size());
      TemplateSeam seam;
      seam.edge_a = edge_names_.find(row.edge_a, where + ": edge_a");
      seam.edge_b = edge_names_.find(row.edge_b, where + ": edge_b");
      seam.side_a = static_cast<Side>(read_choice(row.side_a, VITRINE_SIDE_BACK, where + ": side_a"));
      seam.side_b = static_cast<Side>(read_choice(row.side_b, VITRINE_SIDE_BACK, where + ": side_b"));
      seam.reversed = read_choice(row.reversed, 1, where + ": reversed") == 1;
      expect_zero(row.reserved, where);
      for (const auto& [side, edge] : {std::pair{seam.side_a, seam.edge_a}, std::pair{seam.side_b, seam.edge_b}}) {
        if (copy_.edges[edge].kind != EdgeKind::seam)
          throw Broken{"seam.kind",
                       where + " sews edge " + in_quotes(copy_.edges[edge].name) + ", which is not of kind seam"};
        if (++uses[{side, edge}] > 1)
          throw Broken{"seam.pairs", where + ": edge " + in_quotes(copy_.edges[edge].name) + " of the " +
                                         (side == Side::front ? "front" : "back") + " is sewn twice"};
      }
      copy_.seams.push_back(seam);
    }
    for (std::size_t e = 0; e < copy_.edges.size(); ++e)
      for (const Side side : {Side::front, Side::back})
        if (copy_.edges[e].kind == EdgeKind::seam && !uses.contains({side, static_cast<int>(e)}))
          throw Broken{"seam.pairs", where_ + ": edge " + in_quotes(copy_.edges[e].name) + " of the " +
                                         (side == Side::front ? "front" : "back") + " is of kind seam but in no seam"};
  }

  void limbs() {
    Names names("limb");
    for (const vitrine_limb& row : read_span(table_.limbs, 0, 8, where_ + ": limbs")) {
      TemplateLimb limb;
      limb.name = read_name(row.name, where_ + ": a limb's name");
      names.add(limb.name, where_);
      const std::string where = where_ + ": limb " + in_quotes(limb.name);
      limb.root_a = feature_names_.find(row.root_a, where + ": root_a");
      limb.root_b = feature_names_.find(row.root_b, where + ": root_b");
      limb.tip_a = feature_names_.find(row.tip_a, where + ": tip_a");
      limb.tip_b = feature_names_.find(row.tip_b, where + ": tip_b");
      if (std::set{limb.root_a, limb.root_b, limb.tip_a, limb.tip_b}.size() != 4)
        throw Broken{"limb.corners", where + ": root and tip need four different features"};
      for (const vitrine_name& name : read_span(row.chain, 2, 8, where + ": chain"))
        limb.chain.push_back(
            read_known(name.name, {body_landmarks().begin(), body_landmarks().end()}, where + ": chain"));
      copy_.limbs.push_back(std::move(limb));
    }
  }

  void scale() {
    const vitrine_scale_rule row = read_span(table_.scale, 1, 1, where_ + ": scale").front();
    ScaleRule& rule = copy_.scale;
    const std::string where = where_ + ": scale rule";
    rule.feature_a = feature_names_.find(row.feature_a, where + ": feature_a");
    rule.feature_b = feature_names_.find(row.feature_b, where + ": feature_b");
    rule.girth = read_known(row.girth, {body_girths().begin(), body_girths().end()}, where + ": girth");
    rule.ease = read_number(row.ease, 0.3, 4, where + ": ease");
    rule.top = feature_names_.find(row.top, where + ": top");
    rule.bottom = feature_names_.find(row.bottom, where + ": bottom");
    for (const TemplatePose& pose : copy_.poses) {
      if (!((pose.uv[rule.feature_a] - pose.uv[rule.feature_b]).norm() > 0.01))
        throw Broken{"scale.measurable",
                     where + ": feature_a and feature_b lie in one place in pose " + in_quotes(pose.name)};
      if (!(pose.uv[rule.bottom].y() - pose.uv[rule.top].y() > 0.01))
        throw Broken{"scale.measurable", where + ": top does not lie above bottom in pose " + in_quotes(pose.name)};
    }
  }

  void anchors() {
    Names names("anchor");
    for (const vitrine_name& row : read_span(table_.anchors, 1, 16, where_ + ": anchors")) {
      const int i = feature_names_.find(row.name, where_ + ": anchors");
      names.add(copy_.features[i].name, where_);
      if (copy_.features[i].landmark.empty())
        throw Broken{"anchor.landmark",
                     where_ + ": anchor " + in_quotes(copy_.features[i].name) + " has no body landmark"};
      copy_.anchors.push_back(i);
    }
  }

  void fabrics() {
    Names names("fabric");
    for (const vitrine_fabric& row : read_span(table_.fabrics, 1, 32, where_ + ": fabrics")) {
      Fabric fabric;
      fabric.name = read_name(row.name, where_ + ": a fabric's name");
      names.add(fabric.name, where_);
      const std::string where = where_ + ": fabric " + in_quotes(fabric.name);
      fabric.stretch = read_number(row.stretch, 1, 1e7, where + ": stretch");
      fabric.shear = read_number(row.shear, 0, 1e7, where + ": shear");
      fabric.bend = read_number(row.bend, 0, 1, where + ": bend");
      fabric.mass = read_number(row.mass, 0.01, 5, where + ": mass");
      fabric.friction = read_number(row.friction, 0, 5, where + ": friction");
      copy_.fabrics.push_back(std::move(fabric));
    }
  }

  const vitrine_garment& table_;
  GarmentTemplate copy_;
  std::string where_;
  Names feature_names_{"feature"}, edge_names_{"edge"};
};

}  // namespace

GarmentTemplate copy_garment(const vitrine_garment& table, const PluginIdentity& identity) {
  return GarmentCopy(table, identity).take();
}

}  // namespace vitrine::adoption
