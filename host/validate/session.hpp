// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vitrine/host/child.hpp"
#include "vitrine/host/library.hpp"
#include "vitrine/validate.hpp"

namespace vitrine::validation {

/// The child's side: says which check it enters, and what came of it. All other checks count as skipped.
class Session {
 public:
  Session(const ChildReport& report, const ValidateOptions& options) : options(options), report_(report) {}

  /// From here on a crash is this check's.
  void begin(std::string_view check) const { send("begin", check, ""); }
  void pass(std::string_view check, const std::string& figures = "") const { send("pass", check, figures); }
  void fail(std::string_view check, const std::string& why) const { send("fail", check, why); }
  void skip(std::string_view check, const std::string& why) const { send("skip", check, why); }
  /// Fails with the first of the findings (and says how many there are), or passes.
  void conclude(std::string_view check, const std::vector<std::string>& findings,
                const std::string& figures = "") const;
  /// A fact for the report's head: "id", "version", "garment", "neckline".
  void fact(std::string_view kind, const std::string& value) const { send("fact", kind, value); }
  bool wants(int level) const { return options.level >= level; }

  const ValidateOptions& options;

 private:
  void send(std::string_view what, std::string_view check, const std::string& text) const;
  const ChildReport& report_;
};

/// A figure in a finding: three digits.
std::string number(double value);

/// Code of the error that adopt() gives for a rule: "span.data" is PLUGIN_SPAN_DATA.
std::string code_of_rule(std::string_view rule);

/// A plugin in memory, with what the process was like before and after it was loaded.
struct Subject {
  PluginFile file;
  LoadedPlugin library;
  AdoptedPlugin plugin;
  std::vector<MemoryRange> tables;  ///< every range that adoption read
};

/// Levels 1 and 2, and the adoption rules of 3. False: the plugin cannot be used any further.
bool check_loading(const Session& session, const PluginFile& file, Subject& subject);
/// What goes beyond the adoption rules.
void check_templates(const Session& session, const AdoptedPlugin& plugin);
/// Pairs of edges that cross or touch besides in their common corner.
std::vector<std::pair<std::size_t, std::size_t>> crossing_edges(const GarmentTemplate& garment,
                                                                const TemplatePose& pose);
/// Levels 4 and 5. `folder` is empty and the session's own.
void check_pipeline(const Session& session, const Subject& subject, const std::string& folder);
/// Level 6 but for what check_loading() saw while it loaded; that is reported by it.
void check_hardening(const Session& session, const Subject& subject);
/// At the very end.
void check_stays(const Session& session, const Subject& subject);

/// Copies of the tables as one digest, for comparing two readings of them.
std::string template_digest(const AdoptedPlugin& plugin);
/// SHA-256 [hex] of the bytes in these ranges.
std::string bytes_digest(const std::vector<MemoryRange>& ranges);

}  // namespace vitrine::validation
