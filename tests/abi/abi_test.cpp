// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/abi.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "vitrine/host/registry.hpp"

namespace vitrine {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Lines = std::vector<std::string>;

Lines lines_of(std::istream& in) {
  Lines lines;
  for (std::string line; std::getline(in, line);)
    if (!line.empty() && line[0] != '#') lines.push_back(line);
  return lines;
}

Lines listing(const std::string& program) {
  FILE* pipe = ::popen((std::string(VITRINE_BINARY_DIR) + "/bin/" + program).c_str(), "r");
  std::stringstream text;
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    text.write(buffer.data(), static_cast<std::streamsize>(n));
  EXPECT_EQ(::pclose(pipe), 0) << program;
  return lines_of(text);
}

Lines golden() {
  std::ifstream in(std::string(VITRINE_SOURCE_DIR) + "/tests/abi/abi_1.txt");
  return lines_of(in);
}

std::string version_of(const std::string& line) {
  return line.substr(0, line.find(' '));
}
std::string without_version(const std::string& line) {
  return line.substr(line.find(' ') + 1);
}
/// "layout vitrine_edge size 32 align 8" -> "layout vitrine_edge"; empty for other lines.
std::string struct_of(const std::string& line) {
  return line.starts_with("layout ") ? line.substr(0, line.find(' ', 7)) : "";
}

/// What is wrong between the list of what was ever released and the header of today; empty when nothing is. A struct
/// that grew has a new layout line, and its last one counts; everything else stands as it was.
Lines complaints(const Lines& released, const Lines& today) {
  Lines wrong;
  Lines known;
  int minor = 0;
  for (std::size_t i = 0; i < released.size(); ++i) {
    const int line_minor = std::atoi(version_of(released[i]).substr(2).c_str());
    if (!released[i].starts_with("1.") || line_minor < minor)
      wrong.push_back("versions have to ascend: " + released[i]);
    minor = line_minor;
    const std::string line = without_version(released[i]);
    const bool grew =
        !struct_of(line).empty() &&
        std::any_of(released.begin() + static_cast<std::ptrdiff_t>(i) + 1, released.end(),
                    [&](const std::string& later) { return struct_of(without_version(later)) == struct_of(line); });
    if (grew) continue;
    known.push_back(line);
    if (std::find(today.begin(), today.end(), line) == today.end())
      wrong.push_back("abi.h breaks what was released: " + released[i]);
  }
  for (const std::string& line : today)
    if (std::find(known.begin(), known.end(), line) == known.end())
      wrong.push_back("append to tests/abi/abi_1.txt: " + line);
  return wrong;
}

TEST(Abi, header_describes_what_was_released_and_nothing_that_is_not_listed) {
  EXPECT_THAT(complaints(golden(), listing("vitrine-abi-listing")), IsEmpty());
}

// The list and the copy of the first header hold each other: neither can be mended to suit a change.
TEST(Abi, list_begins_with_the_layout_of_the_frozen_header) {
  Lines first;
  for (const std::string& line : golden())
    if (version_of(line) == "1.0") first.push_back(without_version(line));
  EXPECT_EQ(first, listing("vitrine-abi-listing-1-0"));
  EXPECT_GT(first.size(), 100u);
}

TEST(Abi, newest_version_in_the_list_is_the_header_s) {
  EXPECT_EQ(version_of(golden().back()), std::to_string(VITRINE_ABI_MAJOR) + "." + std::to_string(VITRINE_ABI_MINOR));
}

TEST(AbiCheck, names_what_was_moved_removed_changed_or_not_listed) {
  const Lines released = {"1.0 constant A 1", "1.0 layout s size 16 align 8", "1.0 field s.a offset 0 size 8 double",
                          "1.0 field s.b offset 8 size 4 uint32_t"};
  Lines today;
  for (const std::string& line : released) today.push_back(without_version(line));
  EXPECT_THAT(complaints(released, today), IsEmpty());
  const auto after = [&](std::size_t row, const std::string& line) {
    Lines changed = today;
    changed[row] = line;
    return complaints(released, changed);
  };
  EXPECT_THAT(after(0, "constant A 2"),
              ElementsAre(HasSubstr("breaks what was released: 1.0 constant A 1"), HasSubstr("append")));
  EXPECT_THAT(after(2, "field s.a offset 8 size 8 double"), ElementsAre(HasSubstr("breaks"), HasSubstr("append")));
  // Sizes alone would miss these two: the padding hides them.
  EXPECT_THAT(after(3, "field s.b offset 12 size 4 uint32_t"), ElementsAre(HasSubstr("breaks"), HasSubstr("append")));
  EXPECT_THAT(after(3, "field s.b offset 8 size 4 int32_t"), ElementsAre(HasSubstr("breaks"), HasSubstr("append")));
  EXPECT_THAT(complaints(released, {today.begin(), today.end() - 1}), ElementsAre(HasSubstr("breaks")));
  Lines longer = today;
  longer.push_back("constant B 7");
  EXPECT_THAT(complaints(released, longer), ElementsAre(HasSubstr("append to tests/abi/abi_1.txt: constant B 7")));
}

TEST(AbiCheck, takes_fields_that_a_later_minor_appends) {
  const Lines released = {"1.0 layout s size 8 align 8", "1.0 field s.a offset 0 size 8 double",
                          "1.1 layout s size 16 align 8", "1.1 field s.b offset 8 size 8 double"};
  const Lines today = {"layout s size 16 align 8", "field s.a offset 0 size 8 double",
                       "field s.b offset 8 size 8 double"};
  EXPECT_THAT(complaints(released, today), IsEmpty());
  Lines disordered = released;
  std::swap(disordered[1], disordered[2]);
  EXPECT_THAT(complaints(disordered, today), ElementsAre(HasSubstr("ascend")));
}

TEST(Abi, plugin_built_with_the_header_of_1_0_is_adopted_value_for_value) {
  const std::string file = std::string(VITRINE_BINARY_DIR) + "/tests/abi/built_with_1_0.vitrine.so";
  const PluginRegistry registry = PluginRegistry::load({{file}, {}, false});
  for (const RejectedPlugin& rejected : registry.rejected()) ADD_FAILURE() << rejected.error.message;
  const GarmentTemplate* g = registry.find_garment("jumper_1_0");
  ASSERT_NE(g, nullptr);
  EXPECT_EQ(g->plugin, "org.example.built-with-1-0");
  EXPECT_EQ(g->version, "1.2.3");
  EXPECT_EQ(g->title, "Jumper of 1.0");
  ASSERT_EQ(g->features.size(), 12u);
  EXPECT_EQ(g->features[6].name, "armpit_right");
  EXPECT_EQ(g->features[6].landmark, "armpit_right");
  EXPECT_EQ(g->features[6].mirror, 9);
  EXPECT_EQ(g->features[6].turn, Turn::concave);
  ASSERT_EQ(g->poses.size(), 1u);
  EXPECT_EQ(g->poses[0].uv[6], Vec2(0.70, 0.35));
  EXPECT_EQ(g->poses[0].radius[6], 0.125);
  ASSERT_EQ(g->edges.size(), 12u);
  EXPECT_EQ(g->neck_edge(), 1);
  EXPECT_EQ(g->edges[4].kind, EdgeKind::open);
  ASSERT_EQ(g->seams.size(), 8u);
  EXPECT_EQ(g->seams[7].edge_a, 11);
  EXPECT_EQ(g->seams[7].side_b, Side::back);
  EXPECT_FALSE(g->seams[7].reversed);
  ASSERT_EQ(g->limbs.size(), 2u);
  EXPECT_EQ(g->limbs[1].root_b, 6);
  EXPECT_THAT(g->limbs[1].chain, ElementsAre("shoulder_right", "elbow_right", "wrist_right"));
  EXPECT_EQ(g->scale.girth, "bust");
  EXPECT_EQ(g->scale.ease, 1.25);
  EXPECT_EQ(g->scale.bottom, 8);
  EXPECT_THAT(g->anchors, ElementsAre(1, 2));
  ASSERT_EQ(g->fabrics.size(), 2u);
  EXPECT_EQ(g->fabrics[1].mass, 0.125);
  EXPECT_EQ(g->fabrics[1].friction, 0.25);
  const NecklineTemplate* n = registry.find_neckline("neck_1_0");
  ASSERT_NE(n, nullptr);
  ASSERT_EQ(n->profile.size(), 4u);
  EXPECT_EQ(n->profile[1], Vec2(0.25, 0.5));
  EXPECT_EQ(n->ratio_max, 2.0);
  EXPECT_EQ(n->default_depth, 0.75);
}

}  // namespace
}  // namespace vitrine
