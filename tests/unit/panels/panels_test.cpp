// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/panels.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "garments.hpp"

namespace vitrine {
namespace {

using test::Drawn;
using test::photograph;

PanelOptions chest(double metres, double edge_length = 0.02) {
  PanelOptions options;
  options.edge_length = edge_length;
  options.chest = metres;
  return options;
}

double area(const std::vector<Vec2>& outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

double feature_distance(const Panel& panel, int a, int b) {
  return (panel.outline[panel.corner[a]] - panel.outline[panel.corner[b]]).norm();
}

int segments_of(const Panel& panel, int edge) {
  const int n = static_cast<int>(panel.outline.size());
  return (panel.edges[edge].last - panel.edges[edge].first + n) % n;
}

bool crosses_itself(const std::vector<Vec2>& p) {
  const auto side = [](const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  };
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j + 1 == n) continue;
      const Vec2 &a = p[i], &b = p[i + 1], &c = p[j], &d = p[(j + 1) % n];
      if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return true;
    }
  return false;
}

class PanelsOfGarments : public testing::TestWithParam<double> {};

TEST_P(PanelsOfGarments, outline_is_simple_counter_clockwise_and_covered_once_by_its_edges) {
  for (const Drawn& d : {test::vest(), test::v_neck(), test::long_sleeve(0.05), test::long_sleeve(0.004)}) {
    const Features front = photograph(d), back = photograph(d, {.tilt_deg = 2});
    const auto panels = make_panels(front, back, d.garment, chest(0.5, GetParam()));
    ASSERT_TRUE(panels) << panels.error().message;
    for (const Panel* panel : {&panels->front, &panels->back}) {
      EXPECT_GT(area(panel->outline), 0.1);
      EXPECT_FALSE(crosses_itself(panel->outline));
      std::multiset<int> nodes;
      const int n = static_cast<int>(panel->outline.size());
      ASSERT_EQ(panel->edges.size(), d.garment.edges.size());
      for (std::size_t k = 0; k < panel->edges.size(); ++k) {
        const PanelEdge& e = panel->edges[k];
        EXPECT_EQ(e.template_edge, static_cast<int>(k));
        EXPECT_EQ(e.first, panel->corner[d.garment.edges[k].to]);
        EXPECT_EQ(e.last, panel->corner[d.garment.edges[k].from]);
        for (int i = e.first; i != e.last; i = (i + 1) % n) nodes.insert(i);
      }
      EXPECT_EQ(nodes.size(), panel->outline.size());
      EXPECT_EQ(std::set<int>(nodes.begin(), nodes.end()).size(), panel->outline.size());
    }
  }
}

TEST_P(PanelsOfGarments, sleeves_cut_free_on_the_body_stay_on_their_own_side) {
  // The cuff lies on the body: the side seam runs along the sleeve, round the cuff's corner, and out again to the hem.
  Drawn d = test::long_sleeve(-0.025);
  const Vec2 cuff = d.corners[test::index_of(d, "cuff_lower_right")].metres;
  const std::vector<Vec2> side{cuff + Vec2(-0.003, -0.002), {0.25, 0.045}};
  d.corners[test::index_of(d, "armpit_right")].towards = side;
  d.corners[test::index_of(d, "hem_left")].towards = {{-side[1].x(), side[1].y()}, {-side[0].x(), side[0].y()}};
  for (double tilt : {-3.0, 0.0, 1.5}) {
    const auto panels = make_panels(photograph(d, {.tilt_deg = tilt}), photograph(d, {.pixels_per_metre = 900}),
                                    d.garment, chest(0.5, GetParam()));
    ASSERT_TRUE(panels) << panels.error().message;
    for (const Panel* panel : {&panels->front, &panels->back}) {
      EXPECT_FALSE(crosses_itself(panel->outline));
      EXPECT_GT(area(panel->outline), 0.1);
      for (int f : {test::index_of(d, "cuff_lower_right"), test::index_of(d, "armpit_right")}) {
        const Vec2 at = panel->outline[panel->corner[f]];
        EXPECT_LT((at - panel->outline[panel->corner[test::index_of(d, "hem_right")]] - d.corners[f].metres +
                   d.corners[test::index_of(d, "hem_right")].metres)
                      .norm(),
                  0.006);
      }
    }
  }
}

TEST_P(PanelsOfGarments, seams_pair_node_for_node_with_their_ends) {
  const Drawn d = test::vest();
  const auto panels = make_panels(photograph(d), photograph(test::vest(0.03), {.pixels_per_metre = 900, .width = 1.05}),
                                  d.garment, chest(0.5, GetParam()));
  ASSERT_TRUE(panels);
  std::size_t expected = 0;
  for (std::size_t s = 0; s < d.garment.seams.size(); ++s) {
    const int e = d.garment.seams[s].edge_a;
    EXPECT_EQ(segments_of(panels->front, e), segments_of(panels->back, e));
    EXPECT_GE(segments_of(panels->front, e), 2);
    expected += segments_of(panels->front, e) + 1;
    std::set<std::pair<int, int>> pairs;
    for (const NodePair& p : panels->pairs)
      if (p.seam == static_cast<int>(s)) {
        EXPECT_EQ(p.panel_a, 0);
        EXPECT_EQ(p.panel_b, 1);
        pairs.insert({p.node_a, p.node_b});
      }
    for (int f : {d.garment.edges[e].from, d.garment.edges[e].to})
      EXPECT_TRUE(pairs.count({panels->front.corner[f], panels->back.corner[f]}));
  }
  EXPECT_EQ(panels->pairs.size(), expected);
}

TEST_P(PanelsOfGarments, outline_segments_are_about_the_target_length) {
  const Drawn d = test::vest();
  const auto panels = make_panels(photograph(d), photograph(d), d.garment, chest(0.5, GetParam()));
  ASSERT_TRUE(panels);
  for (std::size_t i = 0; i < panels->front.outline.size(); ++i) {
    const double l = (panels->front.outline[(i + 1) % panels->front.outline.size()] - panels->front.outline[i]).norm();
    EXPECT_GT(l, 0.6 * GetParam());
    EXPECT_LT(l, 1.35 * GetParam());
  }
}

INSTANTIATE_TEST_SUITE_P(coarse_standard_fine, PanelsOfGarments, testing::Values(0.055, 0.05, 0.03, 0.02, 0.007));

TEST(Panels, corners_map_back_to_their_pixels) {
  const Drawn d = test::vest();
  for (double tilt : {-7.0, 0.0, 4.0}) {
    const Features front = photograph(d, {.tilt_deg = tilt}), back = photograph(d, {.pixels_per_metre = 700});
    const auto panels = make_panels(front, back, d.garment, chest(0.5));
    ASSERT_TRUE(panels);
    for (std::size_t f = 0; f < front.points.size(); ++f) {
      const Vec2 p = panels->front.outline[panels->front.corner[f]], q = panels->back.outline[panels->back.corner[f]];
      EXPECT_LT((panels->front.pixel_from_panel(p) - front.points[f].pixel).norm(), 1e-9);
      EXPECT_LT((panels->back.pixel_from_panel(q) - back.points[f].pixel).norm(), 1e-9);
    }
  }
}

TEST(Panels, tilt_is_removed) {
  const Drawn d = test::vest();
  for (double tilt : {-9.0, 6.0}) {
    const auto panels = make_panels(photograph(d, {.tilt_deg = tilt}), photograph(d), d.garment, chest(0.5));
    ASSERT_TRUE(panels);
    for (std::size_t f = 0; f < d.corners.size(); ++f) {
      const Vec2 expected = d.corners[f].metres - Vec2(0, 0.63);
      EXPECT_LT((panels->front.outline[panels->front.corner[f]] - expected).norm(), 0.002) << d.corners[f].name;
    }
  }
}

TEST(Panels, chest_sets_the_scale_of_both_panels) {
  const Drawn d = test::vest();
  const auto panels = make_panels(photograph(d), photograph(d, {.pixels_per_metre = 800}), d.garment, chest(0.55));
  ASSERT_TRUE(panels);
  EXPECT_EQ(panels->scale_source, "chest");
  const ScaleRule& r = d.garment.scale;
  EXPECT_NEAR(feature_distance(panels->front, r.feature_a, r.feature_b), 0.55, 1e-12);
  EXPECT_NEAR(feature_distance(panels->back, r.feature_a, r.feature_b), 0.55, 1e-12);
  EXPECT_NEAR(panels->metres_per_pixel_front, 0.55 / 600, 1e-12);
  EXPECT_NEAR(panels->metres_per_pixel_back, 0.55 / 400, 1e-12);
}

TEST(Panels, length_sets_the_scale_when_it_stands_alone) {
  const Drawn d = test::vest();
  PanelOptions options = chest(0);
  options.length = 0.70;
  const auto panels = make_panels(photograph(d, {.tilt_deg = 5}), photograph(d), d.garment, options);
  ASSERT_TRUE(panels);
  EXPECT_EQ(panels->scale_source, "length");
  const double top = panels->front.outline[panels->front.corner[0]].y();
  EXPECT_NEAR(top - panels->front.outline[panels->front.corner[5]].y(), 0.70, 0.002);
}

TEST(Panels, ease_over_the_body_girth_sets_the_scale_without_measurements) {
  const Drawn d = test::vest();
  PanelOptions options = chest(0);
  EXPECT_EQ(make_panels(photograph(d), photograph(d), d.garment, options).error().code, "MISSING_GIRTH");
  options.girths["bust"] = 0.90;
  const auto panels = make_panels(photograph(d), photograph(d), d.garment, options);
  ASSERT_TRUE(panels);
  EXPECT_EQ(panels->scale_source, "ease");
  EXPECT_NEAR(feature_distance(panels->front, d.garment.scale.feature_a, d.garment.scale.feature_b), 0.477, 1e-12);
}

TEST(Panels, chest_wins_over_a_length_that_disagrees_and_warns) {
  const Drawn d = test::vest();
  PanelOptions options = chest(0.5);
  options.length = 0.62;
  auto panels = make_panels(photograph(d), photograph(d), d.garment, options);
  ASSERT_TRUE(panels);
  EXPECT_TRUE(panels->warnings.empty());
  options.length = 0.5;
  panels = make_panels(photograph(d), photograph(d), d.garment, options);
  ASSERT_TRUE(panels);
  EXPECT_EQ(panels->scale_source, "chest");
  ASSERT_EQ(panels->warnings.size(), 1u);
  EXPECT_EQ(panels->warnings[0].substr(0, 6), "SCALE:");
}

TEST(Panels, four_edges_meet_at_a_crotch_and_its_node_is_paired_with_itself) {
  const Drawn d = test::trousers();
  PanelOptions options;
  options.chest = 0.40;
  const auto panels = make_panels(photograph(d), photograph(d), d.garment, options);
  ASSERT_TRUE(panels) << panels.error().message;
  const int crotch = panels->front.corner[index_of(d, "crotch")], back = panels->back.corner[index_of(d, "crotch")];
  int pairs = 0;
  for (const NodePair& pair : panels->pairs) {
    EXPECT_EQ(pair.node_a == crotch, pair.node_b == back);
    pairs += pair.node_a == crotch;
  }
  EXPECT_EQ(pairs, 2) << "once for each inside leg";
  EXPECT_NEAR(panels->front.outline[crotch].x(), 0, 0.002);
}

TEST(Panels, what_is_sized_by_its_ease_is_no_longer_than_the_body_has_room_for) {
  const Drawn d = test::trousers();
  PanelOptions options;
  options.girths = {{"waist", 1.00}};  // a quarter wider than drawn, so a quarter longer
  const auto extent = [&](const Panels& p, int axis) {
    double low = 1e9, high = -1e9;
    for (const Vec2& q : p.front.outline) low = std::min(low, q[axis]), high = std::max(high, q[axis]);
    return high - low;
  };
  const auto free = make_panels(photograph(d), photograph(d), d.garment, options);
  options.room = 0.90;
  const auto bounded = make_panels(photograph(d), photograph(d), d.garment, options);
  ASSERT_TRUE(free && bounded);
  double lowest = 0;
  for (const Vec2& q : bounded->front.outline) lowest = std::min(lowest, q.y());
  EXPECT_NEAR(lowest, -0.90, 0.01);
  EXPECT_NEAR(extent(*bounded, 0), extent(*free, 0), 1e-3) << "its width stays";
  EXPECT_LT(extent(*bounded, 1), 0.95 * extent(*free, 1));
  EXPECT_TRUE(std::any_of(bounded->warnings.begin(), bounded->warnings.end(),
                          [](const std::string& w) { return w.starts_with("SCALE") && w.find("floor") != w.npos; }));
  EXPECT_NEAR(bounded->worst_seam_ratio, 1, 0.01);
  // A length that was measured is kept, wherever it ends.
  options.length = 1.2;
  const auto measured = make_panels(photograph(d), photograph(d), d.garment, options);
  ASSERT_TRUE(measured);
  EXPECT_NEAR(extent(*measured, 1), 1.2, 0.02);
}

TEST(Panels, mirror_pairs_centre_the_panel_and_anchors_lie_at_zero_height) {
  const Drawn d = test::vest();
  const auto panels = make_panels(photograph(d, {.tilt_deg = 3}), photograph(d), d.garment, chest(0.5));
  ASSERT_TRUE(panels);
  for (const Panel* panel : {&panels->front, &panels->back}) {
    double x = 0, y = 0;
    for (int c : panel->corner) x += panel->outline[c].x();
    for (int a : d.garment.anchors) y += panel->outline[panel->corner[a]].y();
    EXPECT_NEAR(x, 0, 1e-12);
    EXPECT_NEAR(y, 0, 1e-12);
  }
}

TEST(Panels, front_and_back_keep_their_own_neckline) {
  const Drawn front = test::vest(0.14), back = test::vest(0.03);
  const auto panels = make_panels(photograph(front), photograph(back), front.garment, chest(0.5));
  ASSERT_TRUE(panels);
  const auto depth = [](const Panel& panel) {
    const int n = static_cast<int>(panel.outline.size());
    double low = 0;
    for (int i = panel.edges[0].first; i != panel.edges[0].last; i = (i + 1) % n)
      low = std::min(low, panel.outline[i].y());
    return -low;
  };
  EXPECT_NEAR(depth(panels->front), 0.14, 0.003);
  EXPECT_NEAR(depth(panels->back), 0.03, 0.003);
}

TEST(Panels, tip_of_a_v_neck_is_a_node) {
  const Drawn d = test::v_neck();
  const auto panels = make_panels(photograph(d), photograph(d), d.garment, chest(0.5, 0.05));
  ASSERT_TRUE(panels);
  double nearest = 1;
  for (const Vec2& p : panels->front.outline) nearest = std::min(nearest, (p - Vec2(0, -0.18)).norm());
  EXPECT_LT(nearest, 0.002);
}

TEST(Panels, pixel_steps_do_not_lengthen_a_slanted_edge) {
  const Drawn d = test::vest();
  const auto panels = make_panels(photograph(d, {.tilt_deg = 20}), photograph(d), d.garment, chest(0.5));
  ASSERT_TRUE(panels);
  EXPECT_LT(panels->worst_seam_ratio, 1.02);
  const Panel& panel = panels->front;
  const int n = static_cast<int>(panel.outline.size());
  double length = 0;
  for (int i = panel.edges[3].first; i != panel.edges[3].last; i = (i + 1) % n)
    length += (panel.outline[(i + 1) % n] - panel.outline[i]).norm();
  EXPECT_NEAR(length, 0.3901, 0.003);
}

TEST(Panels, contour_walked_the_other_way_gives_the_same_panel) {
  const Drawn d = test::vest();
  const Features front = photograph(d);
  Features reversed = front;
  std::reverse(reversed.contour.begin(), reversed.contour.end());
  for (FeaturePoint& p : reversed.points)
    p.contour_index = static_cast<int>(front.contour.size()) - 1 - p.contour_index;
  const auto a = make_panels(front, front, d.garment, chest(0.5)),
             b = make_panels(reversed, front, d.garment, chest(0.5));
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->front.outline, b->front.outline);
}

TEST(Panels, unequal_seams_warn_and_strangers_are_refused) {
  const Drawn d = test::vest();
  Drawn longer = d;
  for (auto& c : longer.corners)
    if (c.name.starts_with("hem")) c.metres.y() -= 0.12;
  auto panels = make_panels(photograph(d), photograph(longer), d.garment, chest(0.5));
  ASSERT_TRUE(panels);
  EXPECT_NEAR(panels->worst_seam_ratio, 0.51 / 0.39, 0.02);
  EXPECT_EQ(panels->warnings.size(), 2u);
  for (auto& c : longer.corners)
    if (c.name.starts_with("hem")) c.metres.y() -= 0.9;
  panels = make_panels(photograph(d), photograph(longer), d.garment, chest(0.5));
  ASSERT_FALSE(panels);
  EXPECT_EQ(panels.error().code, "FRONT_BACK_MISMATCH");
  EXPECT_EQ(panels.error().cause, Cause::unusable);
}

TEST(Panels, measurements_out_of_range_are_usage_errors) {
  const Drawn d = test::vest();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double bad : {-0.5, 0.01, 3.5, 50.0, nan, std::numeric_limits<double>::infinity()}) {
    PanelOptions by_length = chest(0), by_girth = chest(0);
    by_length.length = bad;
    by_girth.girths["bust"] = bad;
    for (const PanelOptions& options : {chest(bad), by_length, by_girth}) {
      const auto panels = make_panels(photograph(d), photograph(d), d.garment, options);
      ASSERT_FALSE(panels);
      EXPECT_EQ(panels.error().cause, Cause::usage);
      EXPECT_EQ(panels.error().code, "BAD_MEASUREMENT");
    }
  }
  for (double bad : {0.0, -1.0, nan, 1e-9})
    EXPECT_EQ(make_panels(photograph(d), photograph(d), d.garment, chest(0.5, bad)).error().code, "BAD_SETTING");
}

TEST(Panels, broken_features_are_degenerate_outlines) {
  const Drawn d = test::vest();
  const Features good = photograph(d);
  std::vector<Features> bad(6, good);
  bad[0].contour.clear();
  bad[1].contour[7].x() = std::numeric_limits<double>::quiet_NaN();
  bad[2].points[3].contour_index = 1 << 30;
  bad[3].points.pop_back();
  std::swap(bad[4].points[2], bad[4].points[3]);
  bad[5].points[4] = bad[5].points[5];
  for (const Features& f : bad)
    for (const auto& panels :
         {make_panels(f, good, d.garment, chest(0.5)), make_panels(good, f, d.garment, chest(0.5))}) {
      ASSERT_FALSE(panels);
      EXPECT_EQ(panels.error().code, "DEGENERATE_OUTLINE");
      EXPECT_EQ(panels.error().exit_code(), 65);
    }
}

TEST(Panels, figure_eight_is_refused) {
  const Drawn d = test::vest();
  Drawn crossed = d;
  std::swap(crossed.corners[4].metres, crossed.corners[5].metres);
  const auto panels = make_panels(photograph(crossed), photograph(crossed), d.garment, chest(0.5));
  ASSERT_FALSE(panels);
  EXPECT_EQ(panels.error().code, "DEGENERATE_OUTLINE");
}

TEST(Panels, templates_that_do_not_close_are_refused) {
  const Drawn d = test::vest();
  const Features f = photograph(d);
  std::vector<GarmentTemplate> bad(5, d.garment);
  bad[0].edges.clear();
  bad[1].edges[2].to = 99;
  bad[2].seams[0].edge_a = 0;
  bad[3].scale.feature_a = -1;
  bad[4].anchors = {12};
  for (const GarmentTemplate& t : bad) EXPECT_EQ(make_panels(f, f, t, chest(0.5)).error().code, "BAD_TEMPLATE");
}

TEST(Panels, feature_inside_an_edge_becomes_a_node) {
  Drawn d = test::v_neck();
  Features f = photograph(d);
  d.garment.features.push_back({"neck_front", "neck_front", 8, Turn::any});
  int low = 0;
  for (int i = 0; i < f.points[1].contour_index; ++i)
    if (f.contour[i].y() > f.contour[low].y()) low = i;
  f.points.push_back({"neck_front", "", f.contour[low], "neckline", 1, low});
  const auto panels = make_panels(f, f, d.garment, chest(0.5));
  ASSERT_TRUE(panels) << panels.error().message;
  const Vec2 p = panels->front.outline[panels->front.corner[8]];
  EXPECT_LT((panels->front.pixel_from_panel(p) - f.contour[low]).norm(), 1e-9);
}

TEST(Panels, same_input_gives_the_same_bytes) {
  const Drawn d = test::long_sleeve(0.004);
  const Features f = photograph(d, {.tilt_deg = 1.5});
  const auto a = make_panels(f, f, d.garment, chest(0.5)), b = make_panels(f, f, d.garment, chest(0.5));
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->front.outline, b->front.outline);
  EXPECT_EQ(a->back.outline, b->back.outline);
}

}  // namespace
}  // namespace vitrine
