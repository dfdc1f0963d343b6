// SPDX-License-Identifier: GPL-3.0-or-later
#include "text.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "csv.hpp"

namespace vitrine::input {
namespace {

namespace fs = std::filesystem;

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
}
bool is_upper(char c) {
  return c >= 'A' && c <= 'Z';
}
int hex(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || is_upper(c) || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80;
}

Error bad(const char* code, const std::string& where, const std::string& what, const std::string& remedy) {
  return Error{Cause::unusable, code, where + ": " + what, remedy, "catalog"};
}

std::string lower(std::string text) {
  for (char& c : text) c = is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

std::string shortened(std::string_view text, std::size_t bytes) {
  if (text.size() <= bytes) return std::string(text);
  while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xC0) == 0x80) --bytes;
  return std::string(text.substr(0, bytes));
}

std::string one_line(std::string_view text, std::size_t bytes) {
  std::string out;
  for (const char c : text.substr(0, std::min(text.size(), 4 * bytes))) {
    const bool blank = c == ' ' || is_control(c);
    if (!blank)
      out += c;
    else if (!out.empty() && out.back() != ' ')
      out += ' ';
  }
  out = shortened(out, bytes);
  return trimmed(std::string_view(out).substr(0, csv::utf8_length(out)));
}

std::string slug(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool turn = i > 0 && is_upper(c) && text[i - 1] >= 'a' && text[i - 1] <= 'z';
    if ((turn || !is_word(c)) && !out.empty() && out.back() != '-') out += '-';
    if (is_word(c)) out += is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c;
  }
  if (!out.empty() && out.back() == '-') out.pop_back();
  return out;
}

std::string percent_decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int high = text[i] == '%' && i + 2 < text.size() ? hex(text[i + 1]) : -1;
    const int low = high >= 0 ? hex(text[i + 2]) : -1;
    if (low >= 0) {
      out += static_cast<char>(high * 16 + low);
      i += 2;
    } else {
      out += text[i];
    }
  }
  return out;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (true) {
    const auto end = text.find(separator);
    if (std::string part = trimmed(text.substr(0, end)); !part.empty()) parts.push_back(std::move(part));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

bool has_control(std::string_view text) {
  return std::any_of(text.begin(), text.end(), is_control);
}

Result<std::string> read_text(const std::string& path, std::uintmax_t max_bytes, const char* code) {
  std::error_code failed;
  const auto missing = [&](const std::string& why) {
    return Error{Cause::missing, "MANIFEST_MISSING", path + ": " + why,
                 "Check the name of the file and its permissions.", "catalog"};
  };
  const fs::file_status status = fs::status(path, failed);
  if (!fs::exists(status)) return missing("there is no such file");
  if (!fs::is_regular_file(status)) return missing("this is not a file");
  const auto size = fs::file_size(path, failed);
  if (failed) return missing(failed.message());
  if (size > max_bytes)
    return bad(code, path, "the file has more than " + std::to_string(max_bytes >> 20) + " MB",
               "Split it into several catalogues.");
  std::ifstream in(path, std::ios::binary);
  std::string text(size, '\0');
  in.read(text.data(), static_cast<std::streamsize>(size));
  if (!in) return missing("the file cannot be read");
  if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) text.erase(0, 3);
  return text;
}

std::optional<Error> check_utf8(std::string_view text, const std::string& file, const char* code) {
  const std::size_t good = std::min(csv::utf8_length(text), text.find('\0'));
  if (good >= text.size()) return {};
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(good), '\n');
  return bad(code, file + ":" + std::to_string(line), "the text is not UTF-8 from here on",
             "Save or export the file as UTF-8 (\"CSV UTF-8\").");
}

}  // namespace vitrine::input
