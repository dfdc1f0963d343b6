// SPDX-License-Identifier: GPL-3.0-or-later
#include "rules.hpp"

#include <re2/re2.h>

#include <algorithm>
#include <initializer_list>

#include "json_text.hpp"
#include "manifest_fields.hpp"
#include "text.hpp"

namespace vitrine::input {
namespace {

using nlohmann::json;

constexpr std::uintmax_t max_bytes = 1u << 20;
constexpr std::size_t max_rules = 500;

/// Carries an Error out of the nested readers below; never leaves this file.
struct Refused {
  Error error;
};

class RulesReader {
 public:
  RulesReader(std::string file, Rules& rules) : file_(std::move(file)), rules_(rules) {}

  void read(const json& all) {
    if (!all.is_object()) refuse("", "the rules are not an object", "Begin with what --print-rules writes.");
    for (const auto& [key, value] : all.items()) {
      if (key == "columns") {
        columns(value);
      } else if (key == "file_name_tails") {
        rules_.tails.clear();
        for (const std::string& text : texts(value, key)) rules_.tails.push_back(pattern(text, key));
      } else if (key == "pictures") {
        pictures(value);
      } else if (key == "garments") {
        rules_.garments = text_rules(value, key, "garment");
      } else if (key == "necklines") {
        rules_.necklines = text_rules(value, key, "neckline");
      } else if (key == "fabrics") {
        rules_.fabrics = text_rules(value, key, "fabric");
      } else if (key == "measures") {
        measures(value);
      } else if (key == "default_garment") {
        rules_.default_garment = text(value, key);
      } else if (key == "no_garment") {
        rules_.refuse_no_garment = one_of(value, key, "leave_out", "refuse");
      } else if (key == "no_back") {
        rules_.mirror_missing_back = one_of(value, key, "refuse", "mirror");
      } else if (key == "leave_out_status") {
        rules_.left_out_status = texts(value, key);
        for (std::string& status : rules_.left_out_status) status = lower(status);
      } else if (key == "mannequins") {
        rules_.mannequins_from_sizes = value == "sizes";
        rules_.mannequins.clear();
        if (rules_.mannequins_from_sizes) continue;
        for (const std::string& who : texts(value, key)) {
          if (who.find(' ') != std::string::npos || who.empty() || has_control(who))
            refuse(key, "\"" + shortened(who, 40) + "\" is not a size or preset", "Write names without blanks.");
          add_once(rules_.mannequins, who, 32);
        }
      } else {
        refuse(key, "there is no such key", "The keys are those that --print-rules writes.");
      }
    }
  }

 private:
  [[noreturn]] void refuse(const std::string& key, const std::string& what, const std::string& remedy) const {
    throw Refused{bad("RULES", file_ + (key.empty() ? "" : ": \"" + shortened(key, 80) + "\""), what, remedy)};
  }
  std::string text(const json& value, const std::string& key) const {
    if (!value.is_string()) refuse(key, "a text is needed here", "Write it in quotes.");
    return value.get<std::string>();
  }
  const json& list(const json& value, const std::string& key) const {
    if (!value.is_array()) refuse(key, "a list is needed here", "Write it in [ ].");
    if (value.size() > max_rules) refuse(key, "the list has more than 500 entries", "Shorten it.");
    return value;
  }
  std::vector<std::string> texts(const json& value, const std::string& key) const {
    std::vector<std::string> all;
    for (const json& entry : list(value, key)) all.push_back(text(entry, key));
    return all;
  }
  bool one_of(const json& value, const std::string& key, const char* no, const char* yes) const {
    if (value != no && value != yes)
      refuse(key, "this is neither \"" + std::string(no) + "\" nor \"" + yes + "\"", "Write one of the two.");
    return value == yes;
  }
  Pattern pattern(const std::string& text, const std::string& key) const {
    if (text.size() > 2000) refuse(key, "the expression is longer than 2000 bytes", "Make several rules of it.");
    re2::RE2::Options options;
    options.set_case_sensitive(false);
    options.set_log_errors(false);
    options.set_max_mem(4 << 20);
    auto compiled = std::make_shared<const re2::RE2>(text, options);
    if (!compiled->ok())
      refuse(key, "\"" + shortened(text, 60) + "\" is no regular expression: " + compiled->error(),
             "Write it in RE2's syntax; a backslash is written twice in JSON.");
    return compiled;
  }
  /// The entry's keys, with those that are not known refused.
  void check_keys(const json& entry, const std::string& key, std::initializer_list<const char*> known) const {
    if (!entry.is_object()) refuse(key, "each rule is an object", "Write it in { }.");
    for (const auto& [name, value] : entry.items())
      if (std::find(known.begin(), known.end(), name) == known.end())
        refuse(key, "a rule has no \"" + shortened(name, 40) + "\"", "Remove it.");
  }
  std::string name_in(const json& entry, const std::string& key, const std::string& otherwise) const {
    return entry.contains("name") ? one_line(text(entry["name"], key), 60) : otherwise;
  }

  void columns(const json& value) {
    if (!value.is_object() || value.size() > max_rules)
      refuse("columns", "an object is needed here", "Write {\"name in the feed\": \"name that is known\"}.");
    rules_.columns.clear();
    for (const auto& [from, to] : value.items()) rules_.columns[plain_column(from)] = plain_column(text(to, "columns"));
  }

  void pictures(const json& value) {
    rules_.pictures.clear();
    for (const json& group : list(value, "pictures")) {
      std::vector<PictureRule> rules;
      for (const json& entry : list(group, "pictures")) {
        check_keys(entry, "pictures", {"name", "file", "alt", "position", "is"});
        PictureRule rule;
        const int fields =
            static_cast<int>(entry.contains("file") + entry.contains("alt") + entry.contains("position"));
        if (fields != 1 || !entry.contains("is"))
          refuse("pictures", "a rule needs \"is\" and one of \"file\", \"alt\" and \"position\"", "Write both.");
        if (entry.contains("position")) {
          rule.field = PictureRule::Field::position;
          if (!entry["position"].is_number_integer() || entry["position"] < 1 || entry["position"] > 64)
            refuse("pictures", "a position is a whole number from 1 to 64", "Count from 1.");
          rule.position = entry["position"].get<int>();
        } else {
          const bool file = entry.contains("file");
          rule.field = file ? PictureRule::Field::file : PictureRule::Field::alt;
          rule.match = pattern(text(entry[file ? "file" : "alt"], "pictures"), "pictures");
        }
        const std::string is = text(entry["is"], "pictures");
        for (const Role role : {Role::front, Role::back, Role::front_mask, Role::back_mask, Role::other})
          if (is == name_of(role)) rule.role = role;
        if (rule.role == Role::none)
          refuse("pictures", "\"" + shortened(is, 40) + "\" is not what a picture can be",
                 "Choose one of: front, back, front_mask, back_mask, other.");
        rule.name = name_in(entry, "pictures", "pictures-" + std::to_string(rules.size() + 1));
        rules.push_back(std::move(rule));
      }
      rules_.pictures.push_back(std::move(rules));
    }
  }

  std::vector<TextRule> text_rules(const json& value, const std::string& key, const char* what) const {
    std::vector<TextRule> rules;
    for (const json& entry : list(value, key)) {
      // Only garments are looked for in one text and told apart by another.
      const bool garment = key == "garments";
      check_keys(entry, key, {"name", "match", what, garment ? "with" : "garments"});
      if (!entry.contains("match") || !entry.contains(what))
        refuse(key, std::string("a rule needs \"match\" and \"") + what + "\"", "Write both.");
      TextRule rule;
      rule.match = pattern(text(entry["match"], key), key);
      if (entry.contains("with")) rule.with = pattern(text(entry["with"], key), key);
      rule.value = text(entry[what], key);
      if (has_control(rule.value) || rule.value.size() > 200) refuse(key, "the name is not usable", "Shorten it.");
      if (entry.contains("garments")) rule.garments = texts(entry["garments"], key);
      rule.name = name_in(entry, key, key + "-" + std::to_string(rules.size() + 1));
      rules.push_back(std::move(rule));
    }
    return rules;
  }

  void measures(const json& value) {
    rules_.measures.clear();
    for (const json& entry : list(value, "measures")) {
      check_keys(entry, "measures", {"name", "is", "column", "match", "unit"});
      MeasureRule rule;
      const std::string is = entry.contains("is") ? text(entry["is"], "measures") : "";
      if (is != "chest_cm" && is != "length_cm")
        refuse("measures", "\"is\" must be chest_cm or length_cm", "Write one of the two.");
      rule.chest = is == "chest_cm";
      if (entry.contains("column") == entry.contains("match"))
        refuse("measures", "a rule needs either \"column\" or \"match\"", "Write one of the two.");
      if (entry.contains("column")) rule.column = plain_column(text(entry["column"], "measures"));
      if (entry.contains("match")) rule.match = pattern(text(entry["match"], "measures"), "measures");
      if (rule.match && rule.match->NumberOfCapturingGroups() < 1)
        refuse("measures", "the expression has no group for the number", "Put the number in ( ).");
      const std::string unit = entry.contains("unit") ? text(entry["unit"], "measures") : "cm";
      if (unit != "cm" && unit != "mm" && unit != "in")
        refuse("measures", "\"unit\" must be cm, mm or in", "Write one of the three.");
      rule.unit_cm = unit == "cm" ? 1 : unit == "mm" ? 0.1 : 2.54;
      rule.name = name_in(entry, "measures", "measures-" + std::to_string(rules_.measures.size() + 1));
      rules_.measures.push_back(std::move(rule));
    }
  }

  std::string file_;
  Rules& rules_;
};

std::optional<Error> apply(std::string_view text, const std::string& file, Rules& rules) {
  const Result<json> parsed = parse_json(text, file, "RULES");
  if (!parsed) return parsed.error();
  try {
    RulesReader(file, rules).read(*parsed);
  } catch (const Refused& refused) {
    return refused.error;
  }
  return {};
}

}  // namespace

bool found_in(const Pattern& pattern, std::string_view text) {
  return re2::RE2::PartialMatch(re2::StringPiece(text.data(), text.size()), *pattern);
}

const char* name_of(Role role) {
  switch (role) {
    case Role::front:
      return "front";
    case Role::back:
      return "back";
    case Role::front_mask:
      return "front_mask";
    case Role::back_mask:
      return "back_mask";
    case Role::other:
      return "other";
    case Role::none:
      break;
  }
  return "";
}

std::string plain_column(std::string_view name) {
  std::string text = lower(trimmed(name));
  if (text.rfind("g:", 0) == 0) text.erase(0, 2);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

Result<Rules> parse_rules(std::string_view text, const std::string& file) {
  Rules rules;
  if (auto error = apply(default_rules(), "the built-in rules", rules)) return *error;
  if (!text.empty())
    if (auto error = apply(text, file, rules)) return *error;
  return rules;
}

Result<Rules> read_rules(const std::string& path) {
  if (path.empty()) return parse_rules("", "");
  const auto text = read_text(path, max_bytes, "RULES");
  if (!text) return text.error();
  if (text->empty()) return bad("RULES", path, "the file is empty", "Begin with what --print-rules writes.");
  return parse_rules(*text, path);
}

}  // namespace vitrine::input
