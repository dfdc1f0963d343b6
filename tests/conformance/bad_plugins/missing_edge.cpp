// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

namespace {

constexpr std::array seams = [] {
  auto all = vitrine::templates::skirt_seams;
  all[1].edge_b = "pocket";
  return all;
}();
constexpr std::array garments = [] {
  auto all = sound::garments;
  all[0].seams = vitrine::sdk::span(seams);
  return all;
}();

}  // namespace

BROKEN_ENTRY(p.garments = vitrine::sdk::span(garments));
