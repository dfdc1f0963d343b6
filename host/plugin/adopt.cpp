// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/host/adopt.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "adopt_tables.hpp"

namespace vitrine {

namespace {

using adoption::Broken;
using adoption::in_quotes;
using adoption::read_span;
using adoption::read_text;

constexpr auto rules = std::to_array<AdoptionRule>({
    {"entry.magic", "The exported symbol is a Vitrine plugin descriptor."},
    {"entry.abi_major", "The plugin was built for the host's major ABI version."},
    {"entry.abi_minor", "The plugin asks for no newer minor ABI version than the host's."},
    {"entry.size", "The descriptor is at least as large as in ABI 1.0."},
    {"entry.id", "The plugin's id is a reverse URI and its version a semantic version."},
    {"entry.content", "The plugin brings at least one garment or neckline."},
    {"memory.inside", "Every table and text lies inside the library's own image, and ends there."},
    {"memory.aligned", "Tables are aligned as the C compiler aligns them."},
    {"span.count", "Every table has as many elements as it may have."},
    {"span.data", "A table with elements has data."},
    {"span.stride", "A table's stride is at least its element's size."},
    {"text.present", "Every text that is needed is there."},
    {"text.length", "Texts keep to their greatest length."},
    {"text.utf8", "Texts are UTF-8 without control characters."},
    {"name.form", "Names are small letters, digits and underscores and begin with a letter."},
    {"name.unique", "No two things in a table have the same name."},
    {"name.known", "A name that refers to something refers to something that exists."},
    {"number.finite", "Every number is finite."},
    {"number.range", "Every number lies in its range; reserved fields are 0."},
    {"mirror.involution", "The mirror of a feature's mirror is the feature."},
    {"outline.closed", "Each edge begins where the one before ends, and the last ends where the first began."},
    {"outline.order", "The edges visit the features once, in the order of their table."},
    {"outline.neck", "A garment has at most one neck edge."},
    {"pose.complete", "A pose places every feature exactly once."},
    {"pose.clockwise", "The outline of a pose runs clockwise in the picture."},
    {"seam.kind", "Seams sew edges of kind seam only."},
    {"seam.pairs", "Every edge of kind seam is sewn exactly once on the front and once on the back."},
    {"limb.corners", "A limb's root and tip are four different features."},
    {"scale.measurable", "The features that the scale rule measures lie apart in every pose."},
    {"anchor.landmark", "An anchor has a body landmark to hang on."},
    {"neckline.profile", "A neckline's profile runs from (0,0) to (1,0), s ascending, and reaches depth 1."},
});

constexpr auto landmarks = std::to_array<std::string_view>(
    {"neck_left",    "neck_right",  "neck_front", "neck_back",   "shoulder_left", "shoulder_right", "armpit_left",
     "armpit_right", "bust_left",   "bust_right", "under_bust",  "waist",         "waist_left",     "waist_right",
     "hip",          "hip_left",    "hip_right",  "biceps_left", "biceps_right",  "elbow_left",     "elbow_right",
     "wrist_left",   "wrist_right", "crotch",     "thigh_left",  "thigh_right",   "knee_left",      "knee_right",
     "ankle_left",   "ankle_right", "crown"});

constexpr auto girths =
    std::to_array<std::string_view>({"bust", "under_bust", "waist", "hip", "neck_base", "biceps", "wrist", "thigh"});

std::string version_text(std::uint32_t major, std::uint32_t minor) {
  return std::to_string(major) + "." + std::to_string(minor);
}

Error error_of(const Broken& broken, const std::string& who, const std::string& file) {
  Error error;
  error.cause = Cause::plugin;
  error.code = "PLUGIN_";
  for (const char c : broken.rule)
    error.code += c == '.' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  error.message = "plugin " + (who.empty() ? "" : in_quotes(who) + " ") + "in " + file + " breaks the rule " +
                  std::string(broken.rule) + ": " + broken.what;
  error.remedy = "Ask the plugin's author to correct its tables, or remove the file";
  error.stage = "plugin";
  return error;
}

/// Both numbers and both ways out: whoever reads it may own the plugin or the host.
Error version_error(const char* rule, const std::string& file, std::uint32_t major, std::uint32_t minor,
                    const std::string& why, const std::string& remedy) {
  Error error =
      error_of({rule, "it was built for plugin ABI " + version_text(major, minor) + ", this vitrine has ABI " +
                          version_text(VITRINE_ABI_MAJOR, VITRINE_ABI_MINOR) + "; " + why},
               "", file);
  error.remedy = remedy;
  return error;
}

/// The four frozen fields; everything behind them has a meaning only when they are right.
struct Head {
  std::uint32_t magic, major, minor, size;
};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_small(char c) {
  return c >= 'a' && c <= 'z';
}

/// The pieces between separators; an empty text has one empty piece.
std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> pieces;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    pieces.push_back(text.substr(begin, end == std::string_view::npos ? end : end - begin));
    if (end == std::string_view::npos) return pieces;
    begin = end + 1;
  }
}

bool is_reverse_uri(std::string_view id) {
  const auto parts = split(id, '.');
  return parts.size() >= 2 && std::all_of(parts.begin(), parts.end(), [](std::string_view part) {
           return !part.empty() && (is_small(part[0]) || is_digit(part[0])) &&
                  std::all_of(part.begin(), part.end(),
                              [](char c) { return is_small(c) || is_digit(c) || c == '_' || c == '-'; });
         });
}

/// Dot-separated identifiers behind the '-' or '+' of a semantic version.
bool is_version_suffix(std::string_view suffix) {
  const auto parts = split(suffix, '.');
  return std::all_of(parts.begin(), parts.end(), [](std::string_view part) {
    return !part.empty() && std::all_of(part.begin(), part.end(), [](char c) {
      return is_small(c) || is_digit(c) || c == '-' || (c >= 'A' && c <= 'Z');
    });
  });
}

/// https://semver.org: MAJOR.MINOR.PATCH[-PRERELEASE][+BUILD]
bool is_semver(std::string_view version) {
  if (const std::size_t plus = version.find('+'); plus != std::string_view::npos) {
    if (!is_version_suffix(version.substr(plus + 1))) return false;
    version = version.substr(0, plus);
  }
  if (const std::size_t dash = version.find('-'); dash != std::string_view::npos) {
    if (!is_version_suffix(version.substr(dash + 1))) return false;
    version = version.substr(0, dash);
  }
  const auto numbers = split(version, '.');
  return numbers.size() == 3 && std::all_of(numbers.begin(), numbers.end(), [](std::string_view n) {
           return !n.empty() && std::all_of(n.begin(), n.end(), is_digit) && (n.size() == 1 || n[0] != '0');
         });
}

void read_identity(const vitrine_plugin& entry, AdoptedPlugin& plugin) {
  const std::string id = read_text(entry.id, 128, "the plugin's id");
  if (!is_reverse_uri(id))
    throw Broken{"entry.id",
                 "the plugin's id is " + in_quotes(id) + ", not a reverse URI such as \"org.example.poncho\""};
  plugin.identity.id = id;
  plugin.identity.version = read_text(entry.version, 64, "the plugin's version");
  if (!is_semver(plugin.identity.version))
    throw Broken{"entry.id",
                 "the plugin's version is " + in_quotes(plugin.identity.version) + ", not one such as \"1.0.0\""};
  plugin.identity.vendor = read_text(entry.vendor, 200, "the plugin's vendor");
}

}  // namespace

std::span<const AdoptionRule> adoption_rules() {
  return rules;
}
std::span<const std::string_view> body_landmarks() {
  return landmarks;
}
std::span<const std::string_view> body_girths() {
  return girths;
}

Result<AdoptedPlugin> adopt(const LoadedPlugin& plugin, const std::string& file, std::vector<MemoryRange>* read) {
  const adoption::MemoryFence fence(plugin.image, read);
  return adopt(plugin.entry, file);
}

Result<AdoptedPlugin> adopt(const void* entry, const std::string& file) {
  AdoptedPlugin plugin;
  plugin.identity.file = file;
  try {
    if (entry == nullptr) throw Broken{"entry.magic", "there is no descriptor"};
    if (reinterpret_cast<std::uintptr_t>(entry) % alignof(vitrine_plugin) != 0)
      throw Broken{"memory.aligned", "the descriptor is not aligned"};
    adoption::expect_readable(entry, sizeof(Head), "the descriptor");
    Head head;
    std::memcpy(&head, entry, sizeof head);
    if (head.magic != VITRINE_MAGIC) throw Broken{"entry.magic", "the descriptor does not begin with the magic number"};
    if (head.major != VITRINE_ABI_MAJOR)
      return version_error("entry.abi_major", file, head.major, head.minor, "major versions have to be equal",
                           head.major > VITRINE_ABI_MAJOR
                               ? "Update vitrine, or rebuild the plugin with the SDK of ABI " +
                                     version_text(VITRINE_ABI_MAJOR, VITRINE_ABI_MINOR)
                               : "Rebuild the plugin with the SDK of ABI " +
                                     version_text(VITRINE_ABI_MAJOR, VITRINE_ABI_MINOR) +
                                     ", or use a vitrine with plugin ABI " + version_text(head.major, head.minor));
    if (head.minor > VITRINE_ABI_MINOR)
      return version_error(
          "entry.abi_minor", file, head.major, head.minor, "the plugin's minor version may not be newer than vitrine's",
          "Update vitrine, or rebuild the plugin with VITRINE_ABI_TARGET_MINOR=" + std::to_string(VITRINE_ABI_MINOR));
    plugin.abi_major = head.major;
    plugin.abi_minor = head.minor;
    if (head.size < adoption::size_1_0<vitrine_plugin> || head.size > adoption::max_struct_size)
      throw Broken{"entry.size", "the descriptor says it has " + std::to_string(head.size) +
                                     " bytes, it needs at least " + std::to_string(adoption::size_1_0<vitrine_plugin>)};
    adoption::expect_readable(entry, head.size, "the descriptor");
    const auto table = adoption::read_struct<vitrine_plugin>(entry, head.size);
    read_identity(table, plugin);
    const auto garments = read_span(table.garments, 0, 64, "the plugin's garments");
    const auto necklines = read_span(table.necklines, 0, 64, "the plugin's necklines");
    if (garments.empty() && necklines.empty()) throw Broken{"entry.content", "it brings no garment and no neckline"};
    adoption::Names garment_ids("garment"), neckline_ids("neckline");
    for (const vitrine_garment& row : garments) {
      plugin.garments.push_back(adoption::copy_garment(row, plugin.identity));
      garment_ids.add(plugin.garments.back().id, "the plugin");
    }
    for (const vitrine_neckline& row : necklines) {
      plugin.necklines.push_back(adoption::copy_neckline(row, plugin.identity));
      neckline_ids.add(plugin.necklines.back().id, "the plugin");
    }
  } catch (const Broken& broken) {
    return error_of(broken, plugin.identity.id, file);
  }
  return plugin;
}

Result<GarmentTemplate> adopt_garment(const vitrine_garment& table, const PluginIdentity& identity) {
  try {
    return adoption::copy_garment(table, identity);
  } catch (const Broken& broken) {
    return error_of(broken, identity.id, identity.file);
  }
}

Result<NecklineTemplate> adopt_neckline(const vitrine_neckline& table, const PluginIdentity& identity) {
  try {
    return adoption::copy_neckline(table, identity);
  } catch (const Broken& broken) {
    return error_of(broken, identity.id, identity.file);
  }
}

}  // namespace vitrine
