// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vitrine/abi.h"
#include "vitrine/host/library.hpp"
#include "vitrine/model/garment_template.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

/// Where a table came from; errors and the copies carry it.
struct PluginIdentity {
  std::string file;     ///< path of the library, or what else should stand in messages
  std::string id;       ///< reverse URI
  std::string version;  ///< semver
  std::string vendor;
  std::string sha256 = {};  ///< [hex] of the library; empty when there is none
};

/// Everything that one plugin supplies, copied and checked; keeps no pointer into the plugin.
struct AdoptedPlugin {
  PluginIdentity identity;
  std::uint32_t abi_major = 0, abi_minor = 0;
  std::vector<GarmentTemplate> garments;
  std::vector<NecklineTemplate> necklines;
};

/// A named check of adoption. Its name stands in error messages, its description is one sentence for people.
struct AdoptionRule {
  std::string_view name;  ///< e.g. "outline.closed"
  std::string_view description;
};
/// All rules, in the order of docs/ABI.md.
std::span<const AdoptionRule> adoption_rules();

/// The body landmarks that a table may name (Table I; see Mannequin::landmarks) and the girths of a scale rule.
std::span<const std::string_view> body_landmarks();
std::span<const std::string_view> body_girths();

/// Reads the descriptor (first the four frozen fields), then checks and copies all tables.
/// Errors (69): code "PLUGIN_" + the rule in capitals (PLUGIN_OUTLINE_CLOSED); the message names plugin id, file and
/// rule.
Result<AdoptedPlugin> adopt(const void* entry, const std::string& file);

/// The same, and no byte is read outside of the library's own image: whatever its pointers are, they do not bring the
/// process down.
/// `read`, where given, receives every range that was read.
Result<AdoptedPlugin> adopt(const LoadedPlugin& plugin, const std::string& file,
                            std::vector<MemoryRange>* read = nullptr);

/// One garment or neckline without a descriptor around it, as tests and tools have them. Errors as adopt().
Result<GarmentTemplate> adopt_garment(const vitrine_garment& table, const PluginIdentity& identity);
Result<NecklineTemplate> adopt_neckline(const vitrine_neckline& table, const PluginIdentity& identity);

}  // namespace vitrine
