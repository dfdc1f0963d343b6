// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

namespace {

constexpr auto broken = [] {
  auto all = sound::garments;
  all[0].features.count = 1'000'000'000;
  return all;
}();

}  // namespace

constinit const vitrine_plugin vitrine_plugin_entry = sound::with(vitrine::sdk::span(broken));
