// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <initializer_list>
#include <string>
#include <string_view>

#include "csv.hpp"
#include "rules.hpp"

namespace vitrine::input {

/// A feed of rows: the columns by their names, and for each row whether it has as many fields as the header.
class FeedTable {
 public:
  FeedTable(const std::string& file, std::string_view text, const Rules& rules);
  /// The separator with which the first row has the most columns: comma, tab or semicolon.
  static char separator_of(std::string_view text);
  /// Names of the first row, normalised, with the rules' names in place of the feed's.
  static std::vector<std::string> header_of(std::string_view text, const Rules& rules);

  /// Number of the first of these columns that is there, or -1.
  int column(std::initializer_list<const char*> names) const;
  /// The next row. False at the end, or with error() set.
  bool next();
  /// The field, without blanks at its ends; empty where the row has none.
  std::string operator[](int column) const;
  /// The field as one line for people, at most `bytes` long.
  std::string text(int column, std::size_t bytes = 4096) const;
  /// An error for this row where it has not as many fields as the header.
  std::optional<Error> row_problem() const;
  std::string where() const { return file_ + ":" + std::to_string(row_.line); }
  /// Where a field stands: file, line, column and its name.
  std::string where(int column) const;
  int line() const { return row_.line; }
  const std::optional<Error>& error() const { return error_; }
  /// What the rules' measures ask for, of this row.
  void take_measures(Product& product) const;

 private:
  std::string file_;
  const Rules& rules_;
  csv::Reader reader_;
  csv::Row row_;
  std::vector<std::string> header_;
  std::vector<std::pair<std::size_t, int>> measures_;  // rule, column
  std::size_t rows_ = 0;
  std::optional<Error> error_;
};

}  // namespace vitrine::input
