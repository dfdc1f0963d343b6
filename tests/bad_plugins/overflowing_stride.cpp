// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

namespace {

constexpr auto broken = [] {
  auto all = sound::garments;
  all[0].edges.count = 64;
  all[0].edges.stride = 0xfffffff8;
  return all;
}();

}  // namespace

constinit const vitrine_plugin vitrine_plugin_entry = sound::with(vitrine::sdk::span(broken));
