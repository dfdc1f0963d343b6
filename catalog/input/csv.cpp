// SPDX-License-Identifier: GPL-3.0-or-later
#include "csv.hpp"

#include <algorithm>
#include <cstdint>

namespace vitrine::csv {
namespace {

constexpr std::size_t max_fields = 4096;

}  // namespace

bool Reader::field(std::string& out) {
  out.clear();
  if (at_ < text_.size() && text_[at_] == '"') {
    const int opened = line_;
    for (++at_;; ++at_) {
      if (at_ >= text_.size()) {
        line_ = opened;
        problem_ = "a quoted field is opened here and never closed";
        return false;
      }
      const char c = text_[at_];
      if (c == '"') {
        if (at_ + 1 >= text_.size() || text_[at_ + 1] != '"') break;
        ++at_;
      } else if (c == '\n' || (c == '\r' && (at_ + 1 >= text_.size() || text_[at_ + 1] != '\n'))) {
        ++line_;
      }
      out += c;
    }
    ++at_;
    if (at_ < text_.size() && !ends_field(text_[at_])) {
      problem_ = "there is text after a closing quote";
      return false;
    }
  } else {
    const std::size_t first = at_;
    while (at_ < text_.size() && !ends_field(text_[at_])) {
      if (text_[at_] == '"' && !dialect_.loose_quotes) {
        problem_ = "there is a quote inside a field that is not quoted";
        return false;
      }
      ++at_;
    }
    out.append(text_, first, at_ - first);
  }
  if (at_ < text_.size() && text_[at_] == dialect_.separator) {
    ++at_;
    return true;
  }
  if (at_ < text_.size()) {
    if (text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n') ++at_;
    ++at_;
    ++line_;
  }
  return false;
}

bool Reader::next(Row& row) {
  while (at_ < text_.size() && problem_.empty()) {
    row.line = line_;
    std::size_t n = 0;
    bool more = true;
    while (more && problem_.empty()) {
      if (n == max_fields) {
        problem_ = "a row has more than 4096 fields";
        return false;
      }
      if (n == row.fields.size()) row.fields.emplace_back();  // the strings of the last row are used again
      more = field(row.fields[n++]);
    }
    if (!problem_.empty()) return false;
    row.fields.resize(n);
    // A line of commas is what spreadsheets leave below the last row.
    if (!std::all_of(row.fields.begin(), row.fields.end(), [](const std::string& f) { return f.empty(); })) return true;
  }
  return false;
}

std::string quoted(const std::string& field, char separator) {
  const char special[] = {separator, '"', '\r', '\n', '\0'};
  if (field.find_first_of(special) == std::string::npos) return field;
  std::string out = "\"";
  for (const char c : field) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

std::size_t utf8_length(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<std::uint8_t>(text[i]);
    const int more = lead < 0x80                   ? 0
                     : lead >= 0xC2 && lead < 0xE0 ? 1
                     : (lead & 0xF0) == 0xE0       ? 2
                     : lead >= 0xF0 && lead < 0xF5 ? 3
                                                   : -1;
    if (more < 0 || i + static_cast<std::size_t>(more) >= text.size()) return i;
    std::uint32_t code = more == 0 ? lead : lead & (0x3Fu >> more);
    for (int k = 1; k <= more; ++k) {
      const auto byte = static_cast<std::uint8_t>(text[i + static_cast<std::size_t>(k)]);
      if ((byte & 0xC0) != 0x80) return i;
      code = code << 6 | (byte & 0x3Fu);
    }
    if ((more == 2 && (code < 0x800 || (code >= 0xD800 && code < 0xE000))) ||
        (more == 3 && (code < 0x10000 || code > 0x10FFFF)))
      return i;
    i += static_cast<std::size_t>(more) + 1;
  }
  return text.size();
}

}  // namespace vitrine::csv
