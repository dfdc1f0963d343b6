// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vitrine/model/result.hpp"

namespace vitrine::input {

constexpr std::size_t max_rows = 1'000'000;
constexpr std::uintmax_t max_manifest_bytes = 64u << 20;
constexpr std::uintmax_t max_feed_bytes = 256u << 20;
constexpr std::size_t max_field = 4096;  ///< [byte] of a manifest's field, and of what is kept of a feed's

Error bad(const char* code, const std::string& where, const std::string& what, const std::string& remedy);

std::string lower(std::string text);
/// Without blanks at both ends.
std::string trimmed(std::string_view text);
/// At most `bytes` long, not cut inside a character.
std::string shortened(std::string_view text, std::size_t bytes);
/// One line for people: control characters and runs of blanks become one blank; at most `bytes` long.
std::string one_line(std::string_view text, std::size_t bytes);
/// A letter or digit; bytes beyond ASCII count as letters.
bool is_word(char c);
/// Words of letters and digits in lower case, joined by "-"; a capital after a small letter begins a word.
std::string slug(std::string_view text);
/// %41 becomes A; what is no code stays as it is.
std::string percent_decoded(std::string_view text);
std::vector<std::string> split(std::string_view text, char separator);
/// Whether there is a byte below 0x20, or 0x7F.
bool has_control(std::string_view text);

/// The file's text, without a byte order mark. Errors: missing (66, MANIFEST_MISSING), too large (65, `code`).
Result<std::string> read_text(const std::string& path, std::uintmax_t max_bytes, const char* code);
/// Error (65, `code`) naming the line where the text stops being UTF-8 or has a NUL.
std::optional<Error> check_utf8(std::string_view text, const std::string& file, const char* code);

}  // namespace vitrine::input
