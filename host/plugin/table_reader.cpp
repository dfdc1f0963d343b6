// SPDX-License-Identifier: GPL-3.0-or-later
#include "table_reader.hpp"

#include <cmath>
#include <cstdio>

namespace vitrine::adoption {

namespace {
thread_local std::span<const MemoryRange> fence;
thread_local bool fenced = false;
thread_local std::vector<MemoryRange>* record = nullptr;

void note(const void* at, std::size_t size) {
  const auto begin = reinterpret_cast<std::uintptr_t>(at);
  if (record != nullptr) record->push_back({begin, begin + size});
}
}  // namespace

MemoryFence::MemoryFence(std::span<const MemoryRange> ranges, std::vector<MemoryRange>* read) {
  record = read;
  fence = ranges;
  fenced = true;
}
MemoryFence::~MemoryFence() {
  fence = {};
  fenced = false;
  record = nullptr;
}

void expect_readable(const void* at, std::size_t size, const std::string& where) {
  if (readable_bytes(at, size, where) < size) throw Broken{"memory.inside", where + " runs out of the library's image"};
  note(at, size);
}

std::size_t readable_bytes(const void* at, std::size_t most, const std::string& where) {
  if (!fenced) return most;
  const auto address = reinterpret_cast<std::uintptr_t>(at);
  for (const MemoryRange& range : fence)
    if (range.holds(address, 1)) return std::min<std::size_t>(most, range.end - address);
  throw Broken{"memory.inside", where + " points to memory that is not the library's own"};
}

namespace {

/// Length of the UTF-8 sequence at p, 0 if it is none: no overlong forms, surrogates or code points above 10FFFF.
std::size_t utf8_sequence(const unsigned char* p, std::size_t left) {
  const auto tail = [&](std::size_t i) { return i < left && (p[i] & 0xC0) == 0x80; };
  if (p[0] < 0x80) return 1;
  if (p[0] >= 0xC2 && p[0] <= 0xDF) return tail(1) ? 2 : 0;
  if (p[0] >= 0xE0 && p[0] <= 0xEF) {
    if (!tail(1) || !tail(2)) return 0;
    if ((p[0] == 0xE0 && p[1] < 0xA0) || (p[0] == 0xED && p[1] >= 0xA0)) return 0;
    return 3;
  }
  if (p[0] >= 0xF0 && p[0] <= 0xF4) {
    if (!tail(1) || !tail(2) || !tail(3)) return 0;
    if ((p[0] == 0xF0 && p[1] < 0x90) || (p[0] == 0xF4 && p[1] >= 0x90)) return 0;
    return 4;
  }
  return 0;
}

std::string number_text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", value);
  return buffer;
}

}  // namespace

std::string in_quotes(const std::string& text) {
  return "\"" + text + "\"";
}

std::string read_text(const char* text, std::size_t most, const std::string& where) {
  if (text == nullptr) throw Broken{"text.present", where + " is missing (a null pointer)"};
  const std::size_t readable = readable_bytes(text, most + 1, where);
  const std::size_t length = strnlen(text, readable);
  if (length == readable && readable <= most)
    throw Broken{"memory.inside", where + " has no end: it runs out of the library's image"};
  if (length == 0) throw Broken{"text.present", where + " is empty"};
  if (length > most) throw Broken{"text.length", where + " is longer than " + std::to_string(most) + " bytes"};
  const auto* bytes = reinterpret_cast<const unsigned char*>(text);
  for (std::size_t i = 0; i < length;) {
    const std::size_t step = utf8_sequence(bytes + i, length - i);
    if (step == 0) throw Broken{"text.utf8", where + " is not UTF-8 at byte " + std::to_string(i)};
    // Texts are printed on terminals and into web pages: control characters have no place in them.
    const bool c1 = step == 2 && bytes[i] == 0xC2 && bytes[i + 1] < 0xA0;
    if (bytes[i] < 0x20 || bytes[i] == 0x7F || c1)
      throw Broken{"text.utf8", where + " has a control character at byte " + std::to_string(i)};
    i += step;
  }
  note(text, length + 1);
  return {text, length};
}

std::string read_name(const char* text, const std::string& where) {
  std::string name = read_text(text, 64, where);
  const auto letter = [](char c) { return c >= 'a' && c <= 'z'; };
  const auto other = [](char c) { return (c >= '0' && c <= '9') || c == '_'; };
  if (!letter(name[0]) || !std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || other(c); }))
    throw Broken{"name.form", where + " is " + in_quotes(name) +
                                  "; a name is a small letter followed by small letters, digits and underscores"};
  return name;
}

double read_number(double value, double least, double most, const std::string& where) {
  if (!std::isfinite(value)) throw Broken{"number.finite", where + " is not a finite number"};
  if (value < least || value > most)
    throw Broken{"number.range", where + " is " + number_text(value) + ", allowed is " + number_text(least) + " to " +
                                     number_text(most)};
  return value;
}

std::uint32_t read_choice(std::uint32_t value, std::uint32_t most, const std::string& where) {
  if (value > most)
    throw Broken{"number.range", where + " is " + std::to_string(value) + ", allowed is 0 to " + std::to_string(most)};
  return value;
}

void expect_zero(std::uint32_t reserved, const std::string& where) {
  if (reserved != 0) throw Broken{"number.range", where + " has a reserved field that is not 0"};
}

std::string read_known(const char* text, std::vector<std::string_view> known, const std::string& where) {
  std::string name = read_name(text, where);
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw Broken{"name.known", where + " is " + in_quotes(name) + ", which the body does not have"};
  return name;
}

void Names::add(const std::string& name, const std::string& where) {
  if (!index_.emplace(name, static_cast<int>(index_.size())).second)
    throw Broken{"name.unique", where + " has two " + kind_ + "s named " + in_quotes(name)};
}

int Names::find(const char* text, const std::string& where) const {
  const std::string name = read_name(text, where);
  const auto found = index_.find(name);
  if (found == index_.end())
    throw Broken{"name.known", where + " names the " + kind_ + " " + in_quotes(name) + ", which does not exist"};
  return found->second;
}

}  // namespace vitrine::adoption
