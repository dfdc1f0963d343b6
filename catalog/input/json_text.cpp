// SPDX-License-Identifier: GPL-3.0-or-later
#include "json_text.hpp"

#include <algorithm>

#include "text.hpp"

namespace vitrine::input {
namespace {

constexpr int deepest_value = 16;

std::string place(std::string_view text, std::size_t at, const std::string& file) {
  const std::string_view before = text.substr(0, std::min(at, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const auto start = before.rfind('\n');
  const std::size_t column = start == std::string_view::npos ? before.size() + 1 : before.size() - start;
  return file + ":" + std::to_string(line) + ": column " + std::to_string(std::max<std::size_t>(column, 1));
}

}  // namespace

Result<nlohmann::json> parse_json(std::string_view text, const std::string& file, const char* code,
                                  std::vector<int>* object_lines) {
  if (auto error = check_utf8(text, file, code)) return *error;
  // One pass over brackets before anything is built: the depth, and the line of every object.
  int depth = 0, line = 1;
  bool inside = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') ++line;
    if (inside) {
      if (c == '\\')
        ++i;
      else if (c == '"')
        inside = false;
      continue;
    }
    if (c == '"') inside = true;
    if (c == '{' && object_lines != nullptr) object_lines->push_back(line);
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    if (depth > deepest_value)
      return bad(code, place(text, i, file), "the JSON is nested more than 16 levels deep",
                 "Write a list of plain objects.");
  }
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& e) {
    return bad(code, place(text, e.byte > 0 ? e.byte - 1 : 0, file), "this is not JSON",
               "Check commas, quotes and brackets before this place.");
  } catch (const nlohmann::json::exception&) {
    return bad(code, file, "a number is out of range", "Write plain numbers.");
  }
}

}  // namespace vitrine::input
