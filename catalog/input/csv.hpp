// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace vitrine::csv {

struct Row {
  std::vector<std::string> fields;
  int line = 1;  ///< on which it begins
};

/// How much a reader puts up with.
struct Dialect {
  char separator = ',';
  /// Exports that no standard binds: a quote inside an unquoted field is a character like any other.
  bool loose_quotes = false;
};

/// Takes one row after the other from a text (RFC 4180). Rows end with LF, CRLF or CR; empty lines are skipped. A row
/// has at most 4,096 fields.
class Reader {
 public:
  explicit Reader(std::string_view text, Dialect dialect = {}) : text_(text), dialect_(dialect) {}
  /// False at the end of the text, or at an error: then problem() says what and line() where.
  bool next(Row& row);
  const std::string& problem() const { return problem_; }
  int line() const { return line_; }

 private:
  bool field(std::string& out);  ///< true when the row goes on
  bool ends_field(char c) const { return c == dialect_.separator || c == '\r' || c == '\n'; }
  std::string_view text_;
  Dialect dialect_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::string problem_;
};

/// A field as RFC 4180 writes it: in quotes when it has to be.
std::string quoted(const std::string& field, char separator = ',');

/// Number of bytes that are UTF-8 from the start: text.size() when all are.
std::size_t utf8_length(std::string_view text);

}  // namespace vitrine::csv
