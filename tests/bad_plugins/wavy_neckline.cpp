// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

namespace {

constexpr auto profile = std::array<vitrine_profile_point, 5>{{{0, 0}, {0.25, 1}, {0.5, 0.2}, {0.75, 1}, {1, 0}}};
constexpr auto broken = [] {
  auto all = sound::necklines;
  all[0].profile = vitrine::sdk::span(profile);
  return all;
}();

}  // namespace

constinit const vitrine_plugin vitrine_plugin_entry = sound::with(vitrine::sdk::span(broken));
