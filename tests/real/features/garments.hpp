// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The plugins that this build made, as the program loads them.
#include <gtest/gtest.h>

#include <string>

#include "vitrine/host/registry.hpp"

namespace vitrine::test {

inline const PluginRegistry& shipped() {
  static const PluginRegistry registry =
      PluginRegistry::load({{}, {std::string(VITRINE_BINARY_DIR) + "/lib/vitrine-1/plugins"}, false});
  return registry;
}

inline const std::vector<GarmentTemplate>& loaded() {
  return shipped().garments();
}

inline const std::vector<NecklineTemplate>& necklines() {
  return shipped().necklines();
}

/// The garment of an id, or an empty one and a failure.
inline const GarmentTemplate& garment_named(const std::string& id) {
  static const GarmentTemplate none;
  const GarmentTemplate* garment = shipped().find_garment(id);
  if (!garment) ADD_FAILURE() << "no plugin supplies " << id;
  return garment ? *garment : none;
}

}  // namespace vitrine::test
