// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

namespace {

constexpr std::array edges = [] {
  auto all = vitrine::templates::skirt_edges;
  all[3].to = "waist_right";
  return all;
}();
constexpr std::array garments = [] {
  auto all = sound::garments;
  all[0].edges = vitrine::sdk::span(edges);
  return all;
}();

}  // namespace

BROKEN_ENTRY(p.garments = vitrine::sdk::span(garments));
