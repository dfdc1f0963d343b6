// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdio>
#include <string>

namespace vitrine::sewing {

/// Numbers in a sentence of a report, by printf's rules; at most 239 characters.
template <class... Numbers>
std::string text(const char* format, Numbers... numbers) {
  char buffer[240];
  std::snprintf(buffer, sizeof buffer, format, numbers...);
  return buffer;
}

}  // namespace vitrine::sewing
