// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes of real tables, changed at random: adoption says what is wrong, and never reads what is not the library's.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <random>

#include "vitrine/host/adopt.hpp"
#include "vitrine/plugin.hpp"
#include "vitrine/templates/necklines.hpp"
#include "vitrine/templates/sleeve.hpp"

namespace vitrine {
namespace {

/// A plugin's tables in one block of memory, as a library's image holds them, with pointers that stay inside it.
class Image {
 public:
  Image() {
    plugin_ = place(vitrine_plugin{.magic = VITRINE_MAGIC,
                                   .abi_major = VITRINE_ABI_MAJOR,
                                   .abi_minor = VITRINE_ABI_TARGET_MINOR,
                                   .size = sizeof(vitrine_plugin),
                                   .vendor = text("Example"),
                                   .id = text("org.example.some"),
                                   .version = text("1.2.3"),
                                   .garments = {},
                                   .necklines = {},
                                   .extension = nullptr});
    vitrine_garment garment = templates::long_sleeve;
    garment.id = text(garment.id);
    garment.title = text(garment.title);
    copy(garment.features, [&](vitrine_feature& f) { texts({&f.name, &f.landmark, &f.mirror}); });
    copy(garment.poses, [&](vitrine_pose& p) {
      texts({&p.name});
      copy(p.points, [&](vitrine_pose_point& point) { texts({&point.feature}); });
    });
    copy(garment.edges, [&](vitrine_edge& e) { texts({&e.name, &e.from, &e.to}); });
    copy(garment.seams, [&](vitrine_seam& s) { texts({&s.edge_a, &s.edge_b}); });
    copy(garment.limbs, [&](vitrine_limb& l) {
      texts({&l.name, &l.root_a, &l.root_b, &l.tip_a, &l.tip_b});
      copy(l.chain, [&](vitrine_name& n) { texts({&n.name}); });
    });
    copy(garment.scale, [&](vitrine_scale_rule& s) {
      texts({&s.feature_a, &s.feature_b, &s.girth, &s.top, &s.bottom});
    });
    copy(garment.anchors, [&](vitrine_name& n) { texts({&n.name}); });
    copy(garment.fabrics, [&](vitrine_fabric& f) { texts({&f.name}); });
    vitrine_neckline neckline = templates::neck_u;
    neckline.id = text(neckline.id);
    neckline.title = text(neckline.title);
    copy(neckline.profile, [](vitrine_profile_point&) {});
    plugin_->garments = {place(garment), 1, sizeof garment};
    plugin_->necklines = {place(neckline), 1, sizeof neckline};
  }
  std::size_t size() const { return used_; }
  unsigned char* bytes() { return reinterpret_cast<unsigned char*>(block_.get()); }
  LoadedPlugin loaded() {
    const auto begin = reinterpret_cast<std::uintptr_t>(bytes());
    // Nothing behind what is used is readable: a text without an end runs into it.
    return {plugin_, {{begin, begin + used_}}};
  }

 private:
  void* take(std::size_t size) {
    void* at = bytes() + used_;
    used_ += (size + 7) / 8 * 8;
    if (used_ > sizeof(double) * most) std::abort();
    return at;
  }
  template <class T>
  T* place(const T& value) {
    return static_cast<T*>(std::memcpy(take(sizeof value), &value, sizeof value));
  }
  const char* text(const char* from) {
    if (from == nullptr) return nullptr;
    const std::size_t size = std::strlen(from) + 1;
    return static_cast<const char*>(std::memcpy(take(size), from, size));
  }
  void texts(std::initializer_list<const char**> all) {
    for (const char** one : all) *one = text(*one);
  }
  template <class Span, class Each>
  void copy(Span& span, const Each& each) {
    if (span.count == 0) return;
    using Row = std::remove_cvref_t<decltype(*span.data)>;
    auto* rows = static_cast<Row*>(take(span.count * sizeof(Row)));
    std::memcpy(rows, span.data, span.count * sizeof(Row));
    span.data = rows;
    for (std::uint32_t i = 0; i < span.count; ++i) each(rows[i]);
  }

  static constexpr std::size_t most = 4096;
  std::unique_ptr<double[]> block_ = std::make_unique<double[]>(most);
  std::size_t used_ = 0;
  vitrine_plugin* plugin_ = nullptr;
};

TEST(AdoptFence, takes_a_sound_image) {
  Image image;
  std::vector<MemoryRange> read;
  const auto plugin = adopt(image.loaded(), "some.vitrine.so", &read);
  ASSERT_TRUE(plugin) << plugin.error().message;
  EXPECT_EQ(plugin->garments.size(), 1u);
  EXPECT_GT(read.size(), 100u);
  const auto begin = reinterpret_cast<std::uintptr_t>(image.bytes());
  for (const MemoryRange& range : read) {
    EXPECT_GE(range.begin, begin);
    EXPECT_LE(range.end, begin + image.size());
  }
}

// Property: one to four bytes anywhere in the tables, changed at random, never read outside of the image (a wild
// pointer would end this test, and AddressSanitizer sees every step beside a table), and are refused or taken whole.
TEST(AdoptProperty, random_bytes_are_refused_by_a_rule_or_taken_whole) {
  std::mt19937 random(20261124);
  std::map<std::string, int> codes;
  int taken = 0;
  for (int i = 0; i < 20'000; ++i) {
    Image image;
    for (unsigned k = 0; k <= random() % 4; ++k)
      image.bytes()[random() % image.size()] = static_cast<unsigned char>(random());
    const auto plugin = adopt(image.loaded(), "some.vitrine.so");
    if (!plugin) {
      ++codes[plugin.error().code];
      continue;
    }
    ++taken;
    for (const GarmentTemplate& g : plugin->garments) {
      for (const TemplateEdge& e : g.edges) {
        EXPECT_LT(static_cast<std::size_t>(e.from), g.features.size());
        EXPECT_LT(static_cast<std::size_t>(e.to), g.features.size());
      }
      for (const TemplatePose& pose : g.poses) EXPECT_EQ(pose.uv.size(), g.features.size());
    }
  }
  EXPECT_GT(taken, 100);
  for (const char* code : {"PLUGIN_MEMORY_INSIDE", "PLUGIN_SPAN_COUNT", "PLUGIN_NAME_KNOWN", "PLUGIN_TEXT_UTF8",
                           "PLUGIN_NUMBER_RANGE", "PLUGIN_ENTRY_MAGIC"})
    EXPECT_GT(codes[code], 0) << code;
}

// Every pointer in turn: to nowhere, just before and just behind the image, and to its last byte.
TEST(AdoptProperty, every_pointer_may_be_wild) {
  Image counted;
  for (std::size_t at = 0; at + sizeof(void*) <= counted.size(); at += sizeof(void*)) {
    for (const int where : {0, 1, 2, 3}) {
      Image image;
      const auto begin = reinterpret_cast<std::uintptr_t>(image.bytes()), end = begin + image.size();
      std::uintptr_t old = 0;
      std::memcpy(&old, image.bytes() + at, sizeof old);
      if (old < begin || old >= end) break;  // no pointer
      const std::uintptr_t wild[] = {0x1000, begin - 8, end, end - 1};
      std::memcpy(image.bytes() + at, &wild[where], sizeof old);
      const auto plugin = adopt(image.loaded(), "some.vitrine.so");
      EXPECT_FALSE(plugin && where < 3) << "offset " << at << " case " << where;
    }
  }
}

}  // namespace
}  // namespace vitrine
