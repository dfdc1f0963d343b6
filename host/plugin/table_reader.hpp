// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reads ABI tables as what they are: foreign memory. Every value passes one of these functions on its way in.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vitrine/abi.h"
#include "vitrine/host/library.hpp"

namespace vitrine::adoption {

/// Thrown inside adoption only; adopt() turns it into an Error.
struct Broken {
  std::string_view rule;
  std::string what;
};

/// Sizes in ABI 1.0: what a plugin has to bring at least. They stay when the structs grow.
template <class T>
inline constexpr std::size_t size_1_0 = 0;
template <>
inline constexpr std::size_t size_1_0<vitrine_name> = 8;
template <>
inline constexpr std::size_t size_1_0<vitrine_feature> = 32;
template <>
inline constexpr std::size_t size_1_0<vitrine_pose_point> = 32;
template <>
inline constexpr std::size_t size_1_0<vitrine_pose> = 24;
template <>
inline constexpr std::size_t size_1_0<vitrine_edge> = 32;
template <>
inline constexpr std::size_t size_1_0<vitrine_seam> = 32;
template <>
inline constexpr std::size_t size_1_0<vitrine_limb> = 56;
template <>
inline constexpr std::size_t size_1_0<vitrine_scale_rule> = 48;
template <>
inline constexpr std::size_t size_1_0<vitrine_fabric> = 48;
template <>
inline constexpr std::size_t size_1_0<vitrine_garment> = 144;
template <>
inline constexpr std::size_t size_1_0<vitrine_profile_point> = 16;
template <>
inline constexpr std::size_t size_1_0<vitrine_neckline> = 56;
template <>
inline constexpr std::size_t size_1_0<vitrine_plugin> = 80;

/// No struct of any minor version may outgrow this; a larger size or stride is garbage, not a newer plugin.
inline constexpr std::size_t max_struct_size = 4096;

/// While it lives, everything that is read on this thread has to lie in these ranges; without one, anything is read, as
/// for tables that a test keeps on its own stack. This is what stands between a wild pointer and the process.
/// `read`, where given, receives every range that is read.
class MemoryFence {
 public:
  explicit MemoryFence(std::span<const MemoryRange> ranges, std::vector<MemoryRange>* read = nullptr);
  ~MemoryFence();
  MemoryFence(const MemoryFence&) = delete;
  MemoryFence& operator=(const MemoryFence&) = delete;
};

/// Throws memory.inside unless all of [at, at + size) may be read.
void expect_readable(const void* at, std::size_t size, const std::string& where);
/// How many bytes from `at` on may be read, at most `most`; throws memory.inside when none.
std::size_t readable_bytes(const void* at, std::size_t most, const std::string& where);

/// Copies min(size, sizeof) bytes; fields that the plugin does not have yet read as zero.
template <class T>
T read_struct(const void* from, std::size_t size) {
  static_assert(size_1_0<T> != 0 && size_1_0<T> <= sizeof(T));
  T copy{};
  std::memcpy(&copy, from, std::min(size, sizeof(T)));
  return copy;
}

/// The elements of a span; `where` names it in messages.
template <class Span>
auto read_span(const Span& span, std::uint32_t least, std::uint32_t most, const std::string& where) {
  using T = std::remove_cvref_t<decltype(*span.data)>;
  if (span.count < least || span.count > most)
    throw Broken{"span.count", where + " has " + std::to_string(span.count) + " elements, allowed are " +
                                   std::to_string(least) + " to " + std::to_string(most)};
  std::vector<T> copies;
  if (span.count == 0) return copies;
  if (span.data == nullptr)
    throw Broken{"span.data", where + " has " + std::to_string(span.count) + " elements but no data"};
  if (span.stride < size_1_0<T> || span.stride > max_struct_size || span.stride % alignof(T) != 0)
    throw Broken{"span.stride", where + " has a stride of " + std::to_string(span.stride) +
                                    " bytes; its elements have at least " + std::to_string(size_1_0<T>)};
  if (reinterpret_cast<std::uintptr_t>(span.data) % alignof(T) != 0)
    throw Broken{"memory.aligned", where + " does not lie on a multiple of " + std::to_string(alignof(T)) + " bytes"};
  expect_readable(span.data, std::size_t{span.count} * span.stride, where);
  const auto* bytes = reinterpret_cast<const unsigned char*>(span.data);
  for (std::uint32_t i = 0; i < span.count; ++i)
    copies.push_back(read_struct<T>(bytes + std::size_t{i} * span.stride, span.stride));
  return copies;
}

/// UTF-8 text of 1 to `most` bytes without control characters.
std::string read_text(const char* text, std::size_t most, const std::string& where);
/// [a-z][a-z0-9_]*, at most 64 bytes.
std::string read_name(const char* text, const std::string& where);
/// Finite and within [least, most].
double read_number(double value, double least, double most, const std::string& where);
std::uint32_t read_choice(std::uint32_t value, std::uint32_t most, const std::string& where);
void expect_zero(std::uint32_t reserved, const std::string& where);
/// One of `known`, e.g. a body landmark.
std::string read_known(const char* text, std::vector<std::string_view> known, const std::string& where);

/// Names of one table, in order; refuses a second of the same name.
class Names {
 public:
  explicit Names(std::string kind) : kind_(std::move(kind)) {}
  void add(const std::string& name, const std::string& where);
  /// Index of the one that `text` names.
  int find(const char* text, const std::string& where) const;

 private:
  std::string kind_;
  std::map<std::string, int> index_;
};

std::string in_quotes(const std::string& text);

}  // namespace vitrine::adoption
