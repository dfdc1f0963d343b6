// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/host/adopt.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <random>
#include <set>

#include "given.hpp"
#include "mutable_garment.hpp"
#include "vitrine/check.hpp"
#include "vitrine/templates/necklines.hpp"
#include "vitrine/templates/skirt.hpp"
#include "vitrine/templates/sleeve.hpp"

namespace vitrine {
namespace {

using test::identity;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Adopt, copies_every_table_of_a_garment) {
  const auto g = adopt_garment(templates::long_sleeve, identity);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_EQ(g->id, "long_sleeve");
  EXPECT_EQ(g->plugin, "org.example.some");
  EXPECT_EQ(g->version, "1.2.3");
  ASSERT_EQ(g->features.size(), 12u);
  EXPECT_EQ(g->features[3].name, "cuff_upper_right");
  EXPECT_EQ(g->features[3].landmark, "wrist_right");
  EXPECT_EQ(g->features[g->features[3].mirror].name, "cuff_upper_left");
  EXPECT_EQ(g->features[5].turn, Turn::concave);
  ASSERT_EQ(g->edges.size(), 12u);
  EXPECT_EQ(g->neck_edge(), 0);
  EXPECT_EQ(g->edges[0].from, 0);
  EXPECT_EQ(g->edges[0].to, 1);
  EXPECT_EQ(g->seams.size(), 8u);
  for (const TemplateSeam& seam : g->seams) EXPECT_EQ(seam.edge_a, seam.edge_b);
  ASSERT_EQ(g->limbs.size(), 2u);
  EXPECT_THAT(g->limbs[0].chain, testing::ElementsAre("shoulder_left", "elbow_left", "wrist_left"));
  EXPECT_EQ(g->scale.girth, "bust");
  EXPECT_EQ(g->features[g->scale.feature_a].name, "armpit_left");
  EXPECT_THAT(g->anchors, testing::ElementsAre(0, 1));
  EXPECT_EQ(g->fabrics.front().name, "jersey");
  ASSERT_EQ(g->poses.size(), templates::long_sleeve.poses.count);
  EXPECT_EQ(g->poses[0].uv.size(), 12u);
  EXPECT_EQ(g->poses[0].uv[0].x(), templates::long_sleeve.poses.data[0].points.data[0].u);
  EXPECT_EQ(g->poses[0].radius[0], templates::long_sleeve.poses.data[0].points.data[0].radius);
}

TEST(Adopt, pose_points_may_come_in_any_order) {
  MutableGarment m(templates::skirt);
  std::swap(m.points[0][0], m.points[0][2]);
  const auto shuffled = adopt_garment(m.get(), identity);
  const auto ordered = adopt_garment(templates::skirt, identity);
  ASSERT_TRUE(shuffled && ordered);
  EXPECT_EQ(shuffled->poses[0].uv, ordered->poses[0].uv);
}

struct Break {
  const char* promise;
  const char* code;
  std::function<void(MutableGarment&)> change;
};

class AdoptRefuses : public testing::TestWithParam<Break> {};

TEST_P(AdoptRefuses, naming_plugin_file_and_rule) {
  MutableGarment m(templates::long_sleeve);
  ASSERT_TRUE(adopt_garment(m.get(), identity));
  GetParam().change(m);
  // get() has to see the changed rows, but a change to the table itself comes last.
  const auto g = adopt_garment(m.get(), identity);
  ASSERT_FALSE(g);
  EXPECT_EQ(g.error().code, GetParam().code) << g.error().message;
  EXPECT_EQ(g.error().cause, Cause::plugin);
  EXPECT_THAT(g.error().message,
              AllOf(HasSubstr("org.example.some"), HasSubstr("some.vitrine.so"), HasSubstr("rule ")));
  EXPECT_FALSE(g.error().remedy.empty());
}

const std::vector<Break> breaks = {

    Break{"id_with_a_space", "PLUGIN_NAME_FORM", [](auto& m) { m.table.id = "my vest"; }},
    Break{"id_with_a_capital", "PLUGIN_NAME_FORM", [](auto& m) { m.table.id = "Vest"; }},
    Break{"no_title", "PLUGIN_TEXT_PRESENT", [](auto& m) { m.table.title = nullptr; }},
    Break{"broken_utf8", "PLUGIN_TEXT_UTF8", [](auto& m) { m.table.title = "V\xC3("; }},
    Break{"overlong_utf8", "PLUGIN_TEXT_UTF8", [](auto& m) { m.table.title = "\xC0\xAF"; }},
    Break{"surrogate_utf8", "PLUGIN_TEXT_UTF8", [](auto& m) { m.table.title = "\xED\xA0\x80"; }},
    Break{"cut_off_utf8", "PLUGIN_TEXT_UTF8", [](auto& m) { m.table.title = "vest\xE2\x82"; }},
    Break{"terminal_escape", "PLUGIN_TEXT_UTF8", [](auto& m) { m.table.title = "\x1b[31mvest"; }},
    Break{"endless_title", "PLUGIN_TEXT_LENGTH",
          [](auto& m) {
            static const std::string endless(100000, 'x');
            m.table.title = endless.c_str();
          }},
    Break{"too_few_features", "PLUGIN_SPAN_COUNT", [](auto& m) { m.features.resize(2); }},
    Break{"no_poses", "PLUGIN_SPAN_COUNT", [](auto& m) { m.poses.clear(); }},
    Break{"no_fabrics", "PLUGIN_SPAN_COUNT", [](auto& m) { m.fabrics.clear(); }},
    Break{"two_scale_rules", "PLUGIN_SPAN_COUNT", [](auto& m) { m.scale.push_back(m.scale[0]); }},
    Break{"repeated_feature", "PLUGIN_NAME_UNIQUE", [](auto& m) { m.features[1].name = m.features[0].name; }},
    Break{"repeated_edge", "PLUGIN_NAME_UNIQUE", [](auto& m) { m.edges[1].name = m.edges[0].name; }},
    Break{"repeated_pose", "PLUGIN_NAME_UNIQUE", [](auto& m) { m.poses[1].name = m.poses[0].name; }},
    Break{"repeated_fabric", "PLUGIN_NAME_UNIQUE", [](auto& m) { m.fabrics[1].name = m.fabrics[0].name; }},
    Break{"repeated_anchor", "PLUGIN_NAME_UNIQUE", [](auto& m) { m.anchors[1].name = m.anchors[0].name; }},
    Break{"unknown_landmark", "PLUGIN_NAME_KNOWN", [](auto& m) { m.features[0].landmark = "tail"; }},
    Break{"unknown_mirror", "PLUGIN_NAME_KNOWN", [](auto& m) { m.features[0].mirror = "nobody"; }},
    Break{"one_sided_mirror", "PLUGIN_MIRROR_INVOLUTION", [](auto& m) { m.features[0].mirror = "hem_left"; }},
    Break{"impossible_turn", "PLUGIN_NUMBER_RANGE", [](auto& m) { m.features[0].turn = 2; }},
    Break{"reserved_field_used", "PLUGIN_NUMBER_RANGE", [](auto& m) { m.features[0].reserved = 1; }},
    Break{"edge_to_nowhere", "PLUGIN_NAME_KNOWN", [](auto& m) { m.edges[0].to = "nowhere"; }},
    Break{"open_outline", "PLUGIN_OUTLINE_CLOSED", [](auto& m) { m.edges[3].to = "hem_left"; }},
    Break{"missing_edge", "PLUGIN_OUTLINE_CLOSED", [](auto& m) { m.edges.pop_back(); }},
    Break{"edges_against_the_features", "PLUGIN_OUTLINE_ORDER",
          [](auto& m) { std::swap(m.features[3], m.features[8]); }},
    Break{"two_necks", "PLUGIN_OUTLINE_NECK", [](auto& m) { m.edges[6].kind = VITRINE_EDGE_NECK; }},
    Break{"unknown_kind", "PLUGIN_NUMBER_RANGE", [](auto& m) { m.edges[6].kind = 3; }},
    Break{"pose_without_a_feature", "PLUGIN_POSE_COMPLETE", [](auto& m) { m.points[0].pop_back(); }},
    Break{"pose_with_a_feature_twice", "PLUGIN_POSE_COMPLETE",
          [](auto& m) { m.points[0][1].feature = m.points[0][0].feature; }},
    Break{"point_outside_the_box", "PLUGIN_NUMBER_RANGE", [](auto& m) { m.points[0][0].u = 1.01; }},
    Break{"point_that_is_no_number", "PLUGIN_NUMBER_FINITE", [](auto& m) { m.points[1][0].v = nan; }},
    Break{"radius_of_zero", "PLUGIN_NUMBER_RANGE", [](auto& m) { m.points[0][0].radius = 0; }},
    Break{"pose_inside_out", "PLUGIN_POSE_CLOCKWISE",
          [](auto& m) {
            for (auto& point : m.points[0]) point.u = 1 - point.u;
          }},
    Break{"seam_of_an_unknown_edge", "PLUGIN_NAME_KNOWN", [](auto& m) { m.seams[0].edge_b = "pocket"; }},
    Break{"seam_of_an_open_edge", "PLUGIN_SEAM_KIND", [](auto& m) { m.seams[0].edge_b = "hem"; }},
    Break{"edge_sewn_twice", "PLUGIN_SEAM_PAIRS", [](auto& m) { m.seams.push_back(m.seams[0]); }},
    Break{"edge_never_sewn", "PLUGIN_SEAM_PAIRS", [](auto& m) { m.seams.pop_back(); }},
    Break{"side_that_does_not_exist", "PLUGIN_NUMBER_RANGE", [](auto& m) { m.seams[0].side_b = 2; }},
    Break{"limb_of_one_corner", "PLUGIN_LIMB_CORNERS", [](auto& m) { m.limbs[0].root_b = m.limbs[0].root_a; }},
    Break{"limb_of_unknown_landmarks", "PLUGIN_NAME_KNOWN",
          [](auto& m) {
            static constexpr std::array<vitrine_name, 2> chain = {{{"shoulder_left"}, {"wing_left"}}};
            m.limbs[0].chain = sdk::span(chain);
          }},
    Break{"scale_by_an_unknown_girth", "PLUGIN_NAME_KNOWN", [](auto& m) { m.scale[0].girth = "height"; }},
    Break{"scale_of_one_feature", "PLUGIN_SCALE_MEASURABLE",
          [](auto& m) { m.scale[0].feature_b = m.scale[0].feature_a; }},
    Break{"length_upside_down", "PLUGIN_SCALE_MEASURABLE",
          [](auto& m) { std::swap(m.scale[0].top, m.scale[0].bottom); }},
    Break{"endless_ease", "PLUGIN_NUMBER_FINITE", [](auto& m) { m.scale[0].ease = infinity; }},
    Break{"anchor_on_nothing", "PLUGIN_ANCHOR_LANDMARK", [](auto& m) { m.features[0].landmark = nullptr; }},
    Break{"negative_stiffness", "PLUGIN_NUMBER_RANGE", [](auto& m) { m.fabrics[0].stretch = -1; }},
    Break{"weightless_fabric", "PLUGIN_NUMBER_RANGE", [](auto& m) { m.fabrics[0].mass = 0; }},
    Break{"friction_that_is_no_number", "PLUGIN_NUMBER_FINITE", [](auto& m) { m.fabrics[2].friction = nan; }},
};
INSTANTIATE_TEST_SUITE_P(Garment, AdoptRefuses, testing::ValuesIn(breaks),
                         [](const auto& info) { return std::string(info.param.promise); });

TEST(Adopt, refuses_a_span_without_data_or_with_a_short_stride) {
  vitrine_garment g = templates::vest;
  g.seams.data = nullptr;
  EXPECT_EQ(adopt_garment(g, identity).error().code, "PLUGIN_SPAN_DATA");
  g = templates::vest;
  g.seams.stride = 24;
  EXPECT_EQ(adopt_garment(g, identity).error().code, "PLUGIN_SPAN_STRIDE");
  g = templates::vest;
  g.seams.stride = 33;
  EXPECT_EQ(adopt_garment(g, identity).error().code, "PLUGIN_SPAN_STRIDE");
  g = templates::vest;
  g.features.count = 4000000000u;
  EXPECT_EQ(adopt_garment(g, identity).error().code, "PLUGIN_SPAN_COUNT");
}

// What a plugin of a later minor version looks like: its rows have grown, the fields that this host knows have not
// moved.
TEST(Adopt, reads_rows_that_have_grown) {
  struct Grown {
    vitrine_fabric fabric;
    double elasticity;
  };
  static const Grown grown[] = {{templates::jersey, 1}, {templates::denim, 2}};
  vitrine_garment g = templates::vest;
  g.fabrics = {&grown[0].fabric, 2, sizeof(Grown)};
  const auto adopted = adopt_garment(g, identity);
  ASSERT_TRUE(adopted) << adopted.error().message;
  EXPECT_EQ(adopted->fabrics[1].name, "denim");
  EXPECT_DOUBLE_EQ(adopted->fabrics[1].stretch, templates::denim.stretch);
}

TEST(AdoptNeckline, copies_and_checks) {
  const auto u = adopt_neckline(templates::neck_u, identity);
  ASSERT_TRUE(u) << u.error().message;
  EXPECT_EQ(u->profile.size(), templates::u_profile.size());
  EXPECT_DOUBLE_EQ(u->ratio_max, templates::neck_u.ratio_max);

  const auto code = [](auto change) {
    std::vector<vitrine_profile_point> points(templates::square_profile.begin(), templates::square_profile.end());
    vitrine_neckline n = templates::neck_square;
    n.profile.data = points.data();
    change(n, points);
    const auto result = adopt_neckline(n, identity);
    return result ? std::string("adopted") : result.error().code;
  };
  EXPECT_EQ(code([](auto&, auto&) {}), "adopted");
  EXPECT_EQ(code([](auto& n, auto&) { n.profile.count = 2; }), "PLUGIN_SPAN_COUNT");
  EXPECT_EQ(code([](auto&, auto& p) { p[2].s = p[1].s; }), "PLUGIN_NECKLINE_PROFILE");
  EXPECT_EQ(code([](auto&, auto& p) { p[0].depth = 0.1; }), "PLUGIN_NECKLINE_PROFILE");
  EXPECT_EQ(code([](auto&, auto& p) { p[1].depth = p[2].depth = 0.9; }), "PLUGIN_NECKLINE_PROFILE");
  EXPECT_EQ(code([](auto&, auto& p) { p[1].depth = nan; }), "PLUGIN_NUMBER_FINITE");
  EXPECT_EQ(code([](auto& n, auto&) { n.ratio_max = n.ratio_min; }), "PLUGIN_NUMBER_RANGE");
  EXPECT_EQ(code([](auto& n, auto&) { n.ratio_max = infinity; }), "PLUGIN_NUMBER_FINITE");
  EXPECT_EQ(code([](auto& n, auto&) { n.default_depth = 0; }), "PLUGIN_NUMBER_RANGE");
}

// Property: no change of the bytes of a table's numbers and counts brings adoption down or lets a number out of range
// in.
TEST(AdoptProperty, random_numbers_are_refused_or_stay_in_range) {
  std::mt19937 random(20240917);
  const double values[] = {0, -0.0, 1, -1, 0.5, 1e-320, 1e300, -1e300, nan, infinity, -infinity, 2, 0.999999};
  int adopted = 0;
  for (int i = 0; i < 3000; ++i) {
    MutableGarment m(templates::long_sleeve);
    const double value = values[random() % std::size(values)];
    auto& point = m.points[random() % m.points.size()][random() % 12];
    auto& fabric = m.fabrics[random() % m.fabrics.size()];
    double* places[] = {&point.u,     &point.v,     &point.radius,    &fabric.stretch, &fabric.shear,
                        &fabric.bend, &fabric.mass, &fabric.friction, &m.scale[0].ease};
    *places[random() % std::size(places)] = value;
    const auto g = adopt_garment(m.get(), identity);
    if (!g) continue;
    ++adopted;
    for (const TemplatePose& pose : g->poses)
      for (std::size_t f = 0; f < pose.uv.size(); ++f) {
        EXPECT_TRUE((pose.uv[f].array() >= 0).all() && (pose.uv[f].array() <= 1).all());
        EXPECT_TRUE(pose.radius[f] > 0 && pose.radius[f] <= 0.5);
      }
    for (const Fabric& f : g->fabrics) EXPECT_TRUE(f.stretch >= 1 && f.mass > 0 && f.friction >= 0 && f.friction <= 5);
  }
  EXPECT_GT(adopted, 100);
}

std::string code_of(std::string_view rule) {
  std::string code = "PLUGIN_";
  for (const char c : rule) code += c == '.' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return code;
}

// A rule that no test ever breaks may as well not be checked. The rest is broken by the tests of spans, descriptor,
// neckline.
TEST(AdoptionRules, are_each_broken_by_some_test) {
  std::set<std::string> broken = {"PLUGIN_MEMORY_INSIDE", "PLUGIN_MEMORY_ALIGNED", "PLUGIN_SPAN_DATA",
                                  "PLUGIN_SPAN_STRIDE", "PLUGIN_NECKLINE_PROFILE"};
  for (const Break& b : breaks) broken.insert(b.code);
  for (const AdoptionRule& rule : adoption_rules())
    if (!rule.name.starts_with("entry.")) {
      EXPECT_TRUE(broken.contains(code_of(rule.name))) << rule.name;
    }
}

TEST(AdoptionRules, stand_in_the_documentation_as_they_are) {
  std::ifstream in(VITRINE_SOURCE_DIR "/docs/ABI.md");
  const std::string page((std::istreambuf_iterator<char>(in)), {});
  for (const AdoptionRule& rule : adoption_rules())
    EXPECT_THAT(page, HasSubstr("| `" + std::string(rule.name) + "` | " + std::string(rule.description) + " |"));
  for (const auto names : {body_landmarks(), body_girths()})
    for (const std::string_view name : names) EXPECT_THAT(page, HasSubstr(std::string(name)));
}

// Every rule that an error can name is listed, and described in a sentence.
TEST(AdoptionRules, are_unique_and_described) {
  std::set<std::string_view> names;
  for (const AdoptionRule& rule : adoption_rules()) {
    EXPECT_TRUE(names.insert(rule.name).second) << rule.name;
    EXPECT_TRUE(rule.description.ends_with('.')) << rule.name;
  }
  for (const char* rule : {"entry.magic", "outline.closed", "seam.pairs", "span.data", "text.utf8", "number.finite"})
    EXPECT_TRUE(names.contains(rule)) << rule;
}

// The author's compiler comes to the same verdict as the host.
namespace compile_time {

constexpr vitrine_garment with_edges(vitrine_garment g, vitrine_edge_span edges) {
  g.edges = edges;
  return g;
}
constexpr vitrine_garment with_seams(vitrine_garment g, vitrine_seam_span seams) {
  g.seams = seams;
  return g;
}
constexpr auto open_edges = [] {
  auto edges = templates::skirt_edges;
  edges[3].to = "hem_right";
  return edges;
}();
constexpr auto stray_seams = [] {
  auto seams = templates::skirt_seams;
  seams[1].edge_b = "pocket";
  return seams;
}();
constexpr auto hem_seams = [] {
  auto seams = templates::skirt_seams;
  seams[1].edge_b = "hem";
  return seams;
}();
constexpr auto lonely_mirror = [] {
  auto features = templates::skirt_features;
  features[0].mirror = "hem_right";
  return features;
}();
constexpr vitrine_garment with_features(vitrine_garment g, vitrine_feature_span features) {
  g.features = features;
  return g;
}
constexpr auto dented = [] {
  auto profile = templates::v_profile;
  profile[1].depth = 0.5;
  return profile;
}();
constexpr vitrine_neckline with_profile(vitrine_neckline n, vitrine_profile_point_span profile) {
  n.profile = profile;
  return n;
}

static_assert(sdk::check(templates::vest) && sdk::check(templates::long_sleeve) && sdk::check(templates::skirt));
static_assert(sdk::check(templates::neck_u) && sdk::check(templates::neck_v) && sdk::check(templates::neck_square));

template <class Table>
consteval bool breaks(const Table& table, std::string_view rule) {
  return std::string_view(sdk::broken_rule(table).text).starts_with(rule);
}
static_assert(breaks(with_edges(templates::skirt, sdk::span(open_edges)), "outline.closed"));
static_assert(breaks(with_seams(templates::skirt, sdk::span(stray_seams)), "name.known"));
static_assert(breaks(with_seams(templates::skirt, sdk::span(hem_seams)), "seam.kind"));
static_assert(breaks(with_features(templates::skirt, sdk::span(lonely_mirror)), "mirror.involution"));
static_assert(breaks(with_profile(templates::neck_v, sdk::span(dented)), "neckline.profile"));

TEST(CompileTime, knows_the_same_landmarks_and_girths_as_the_host) {
  EXPECT_TRUE(std::ranges::equal(sdk::body_landmarks, body_landmarks()));
  EXPECT_TRUE(std::ranges::equal(sdk::body_girths, body_girths()));
}

}  // namespace compile_time

}  // namespace
}  // namespace vitrine
