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

/// Takes one row after the other from a text (RFC 4180). Rows end with LF, CRLF or CR; empty lines are skipped.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}
  /// False at the end of the text, or at an error: then problem() says what and line() where.
  bool next(Row& row);
  const std::string& problem() const { return problem_; }
  int line() const { return line_; }

 private:
  bool field(std::string& out);  ///< true when the row goes on
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::string problem_;
};

bool is_utf8(std::string_view text);

}  // namespace vitrine::csv
