// SPDX-License-Identifier: GPL-3.0-or-later
#include "csv.hpp"

#include <algorithm>
#include <cstdint>

namespace vitrine::csv {

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
    if (at_ < text_.size() && text_[at_] != ',' && text_[at_] != '\r' && text_[at_] != '\n') {
      problem_ = "there is text after a closing quote";
      return false;
    }
  } else {
    while (at_ < text_.size() && text_[at_] != ',' && text_[at_] != '\r' && text_[at_] != '\n') {
      if (text_[at_] == '"') {
        problem_ = "there is a quote inside a field that is not quoted";
        return false;
      }
      out += text_[at_++];
    }
  }
  if (at_ < text_.size() && text_[at_] == ',') {
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
    row.fields.clear();
    row.line = line_;
    std::string value;
    bool more = true;
    while (more && problem_.empty()) {
      more = field(value);
      row.fields.push_back(value);
    }
    if (!problem_.empty()) return false;
    // A line of commas is what spreadsheets leave below the last row.
    if (!std::all_of(row.fields.begin(), row.fields.end(), [](const std::string& f) { return f.empty(); })) return true;
  }
  return false;
}

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<std::uint8_t>(text[i]);
    const int more = lead < 0x80                   ? 0
                     : lead >= 0xC2 && lead < 0xE0 ? 1
                     : (lead & 0xF0) == 0xE0       ? 2
                     : lead >= 0xF0 && lead < 0xF5 ? 3
                                                   : -1;
    if (more < 0 || i + static_cast<std::size_t>(more) >= text.size()) return false;
    std::uint32_t code = more == 0 ? lead : lead & (0x3Fu >> more);
    for (int k = 1; k <= more; ++k) {
      const auto byte = static_cast<std::uint8_t>(text[i + static_cast<std::size_t>(k)]);
      if ((byte & 0xC0) != 0x80) return false;
      code = code << 6 | (byte & 0x3Fu);
    }
    if ((more == 2 && (code < 0x800 || (code >= 0xD800 && code < 0xE000))) ||
        (more == 3 && (code < 0x10000 || code > 0x10FFFF)))
      return false;
    i += static_cast<std::size_t>(more) + 1;
  }
  return true;
}

}  // namespace vitrine::csv
