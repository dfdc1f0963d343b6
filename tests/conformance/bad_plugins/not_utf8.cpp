// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

namespace {

constexpr std::array garments = [] {
  auto all = sound::garments;
  all[0].title =
      "R\xF6"
      "ckchen";  // Latin-1
  return all;
}();

}  // namespace

BROKEN_ENTRY(p.garments = vitrine::sdk::span(garments));
