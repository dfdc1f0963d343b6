// SPDX-License-Identifier: GPL-3.0-or-later
#include <limits>

#include "sound.hpp"

namespace {

constexpr std::array fabrics = [] {
  auto all = vitrine::templates::skirt_fabrics;
  all[0].mass = std::numeric_limits<double>::quiet_NaN();
  return all;
}();
constexpr std::array garments = [] {
  auto all = sound::garments;
  all[0].fabrics = vitrine::sdk::span(fabrics);
  return all;
}();

}  // namespace

BROKEN_ENTRY(p.garments = vitrine::sdk::span(garments));
