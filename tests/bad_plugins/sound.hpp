// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The plugins that the broken ones start from.
#include <limits>

#include "vitrine/plugin.hpp"
#include "vitrine/templates/necklines.hpp"
#include "vitrine/templates/skirt.hpp"
#include "vitrine/templates/sleeve.hpp"
#include "vitrine/templates/torso.hpp"

namespace sound {

namespace templates = vitrine::templates;
namespace sdk = vitrine::sdk;

template <class T>
using Copy = std::remove_const_t<T>;

/// All tables of a garment in one pose, each of them free to be changed.
struct Skirt {
  const char *id = "skirt", *title = "Skirt";
  Copy<decltype(templates::skirt_features)> features = templates::skirt_features;
  Copy<decltype(templates::skirt_straight)> pose = templates::skirt_straight;
  Copy<decltype(templates::skirt_edges)> edges = templates::skirt_edges;
  Copy<decltype(templates::skirt_seams)> seams = templates::skirt_seams;
  std::array<vitrine_limb, 0> limbs{};
  vitrine_scale_rule scale = templates::skirt_scale;
  std::array<vitrine_name, 2> anchors = templates::skirt_anchors;
  std::array<vitrine_fabric, 2> fabrics = {templates::cotton_woven, templates::denim};
};
struct Vest {
  const char *id = "vest", *title = "Vest";
  Copy<decltype(templates::vest_features)> features = templates::vest_features;
  Copy<decltype(templates::vest_wide_straps)> pose = templates::vest_wide_straps;
  Copy<decltype(templates::vest_edges)> edges = templates::vest_edges;
  Copy<decltype(templates::torso_seams)> seams = templates::torso_seams;
  std::array<vitrine_limb, 0> limbs{};
  vitrine_scale_rule scale = templates::vest_scale;
  std::array<vitrine_name, 2> anchors = templates::torso_anchors;
  std::array<vitrine_fabric, 1> fabrics = {templates::jersey};
};
struct Sleeves {
  const char *id = "long_sleeve", *title = "Long-sleeved top";
  Copy<decltype(templates::long_sleeve_features)> features = templates::long_sleeve_features;
  Copy<decltype(templates::sleeves_wide)> pose = templates::sleeves_wide;
  Copy<decltype(templates::long_sleeve_edges)> edges = templates::long_sleeve_edges;
  Copy<decltype(templates::long_sleeve_seams)> seams = templates::long_sleeve_seams;
  Copy<decltype(templates::sleeve_limbs)> limbs = templates::sleeve_limbs;
  vitrine_scale_rule scale = templates::long_sleeve_scale;
  std::array<vitrine_name, 2> anchors = templates::torso_anchors;
  std::array<vitrine_fabric, 1> fabrics = {templates::jersey};
};

template <const auto& t>
inline constexpr auto poses_of = std::array<vitrine_pose, 1>{{{"flat", sdk::span(t.pose)}}};

template <const auto& t>
constexpr vitrine_garment garment_of() {
  return {.id = t.id,
          .title = t.title,
          .features = sdk::span(t.features),
          .poses = sdk::span(poses_of<t>),
          .edges = sdk::span(t.edges),
          .seams = sdk::span(t.seams),
          .limbs = {t.limbs.data(), static_cast<std::uint32_t>(t.limbs.size()), sizeof(vitrine_limb)},
          .scale = sdk::span_one(t.scale),
          .anchors = sdk::span(t.anchors),
          .fabrics = sdk::span(t.fabrics)};
}

inline constexpr auto skirt = Skirt{};
inline constexpr auto garments = std::array<vitrine_garment, 1>{garment_of<skirt>()};
inline constexpr auto necklines = std::array<vitrine_neckline, 1>{templates::neck_v};
inline constexpr vitrine_plugin entry = {.magic = VITRINE_MAGIC,
                                         .abi_major = VITRINE_ABI_MAJOR,
                                         .abi_minor = VITRINE_ABI_TARGET_MINOR,
                                         .size = sizeof(vitrine_plugin),
                                         .vendor = "Example",
                                         .id = "org.example.sound",
                                         .version = "1.0.0",
                                         .garments = sdk::span(garments),
                                         .necklines = {},
                                         .extension = nullptr};

constexpr vitrine_plugin with(vitrine_garment_span changed) {
  vitrine_plugin p = entry;
  p.garments = changed;
  return p;
}
/// A neckline alone: no garment that level 4 would have to dress.
constexpr vitrine_plugin with(vitrine_neckline_span changed) {
  vitrine_plugin p = entry;
  p.garments = {};
  p.necklines = changed;
  return p;
}

}  // namespace sound

/// The sound plugin after one change: `p` in the statements is the descriptor.
#define BROKEN_ENTRY(...)                                    \
  constinit const vitrine_plugin vitrine_plugin_entry = [] { \
    vitrine_plugin p = sound::entry;                         \
    __VA_ARGS__;                                             \
    return p;                                                \
  }()

/// A sound garment (Skirt, Vest or Sleeves) after one change: `t` in the statements are its tables.
#define BROKEN_GARMENT(Kind, ...)                                                      \
  namespace {                                                                          \
  constexpr auto tables = [] {                                                         \
    using namespace sound;                                                             \
    Kind t;                                                                            \
    __VA_ARGS__;                                                                       \
    return t;                                                                          \
  }();                                                                                 \
  constexpr auto broken = std::array<vitrine_garment, 1>{sound::garment_of<tables>()}; \
  }                                                                                    \
  constinit const vitrine_plugin vitrine_plugin_entry = sound::with(vitrine::sdk::span(broken))

/// A sound neckline whose library does something else besides.
#define SOUND_NECKLINE() \
  constinit const vitrine_plugin vitrine_plugin_entry = sound::with(vitrine::sdk::span(sound::necklines))

/// What the library does when it is loaded.
#define AT_LOAD [[gnu::constructor, gnu::used]] static void at_load()
