// SPDX-License-Identifier: MIT
#pragma once
// C++20 comfort over abi.h for authors of plugins: spans from arrays, composition of tables, symmetric poses, the
// entry. Everything is evaluated by the compiler; a plugin written with it is data only.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "vitrine/abi.h"

namespace vitrine::sdk {

/// The span type of an element type, e.g. span_of<vitrine_edge> is vitrine_edge_span.
template <class T>
struct SpanOf;
#define VITRINE_SPAN_OF(type) \
  template <>                 \
  struct SpanOf<type> {       \
    using Type = type##_span; \
  }
VITRINE_SPAN_OF(vitrine_name);
VITRINE_SPAN_OF(vitrine_feature);
VITRINE_SPAN_OF(vitrine_pose_point);
VITRINE_SPAN_OF(vitrine_pose);
VITRINE_SPAN_OF(vitrine_edge);
VITRINE_SPAN_OF(vitrine_seam);
VITRINE_SPAN_OF(vitrine_limb);
VITRINE_SPAN_OF(vitrine_scale_rule);
VITRINE_SPAN_OF(vitrine_fabric);
VITRINE_SPAN_OF(vitrine_garment);
VITRINE_SPAN_OF(vitrine_profile_point);
VITRINE_SPAN_OF(vitrine_neckline);
#undef VITRINE_SPAN_OF

/// Span over a static array. The array must be static (constexpr at namespace scope): the host reads it later.
template <class T, std::size_t n>
constexpr auto span(const std::array<T, n>& table) {
  return typename SpanOf<T>::Type{table.data(), static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(sizeof(T))};
}
template <class T, std::size_t n>
constexpr auto span(const T (&table)[n]) {
  return typename SpanOf<T>::Type{table, static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(sizeof(T))};
}
/// A temporary would be gone before the host reads it.
template <class T, std::size_t n>
void span(const std::array<T, n>&& table) = delete;
template <class T, std::size_t n>
void span(const T (&&table)[n]) = delete;

/// Span over one static element, e.g. the scale rule.
template <class T>
requires std::is_class_v<T>
constexpr typename SpanOf<T>::Type span_one(const T& element) {
  return {&element, 1, static_cast<std::uint32_t>(sizeof(T))};
}
template <class T>
void span_one(const T&& element) = delete;

/// One table out of several, in order: how a long sleeve is made of a torso and two sleeves.
template <class T, std::size_t... n>
consteval auto join(const std::array<T, n>&... parts) {
  std::array<T, (n + ...)> all{};
  std::size_t next = 0;
  const auto append = [&](const auto& part) {
    for (const T& element : part) all[next++] = element;
  };
  (append(parts), ...);
  return all;
}

/// Names are equal when their letters are; two null names are equal.
constexpr bool same(const char* a, const char* b) {
  if (a == nullptr || b == nullptr) return a == b;
  return std::string_view(a) == std::string_view(b);
}

/// A pose of a symmetric garment from the points of its left half (and of the middle line): the partner of a feature at
/// u lies at 1 - u. A feature that neither the half nor its mirror names does not compile.
template <std::size_t n, std::size_t m>
consteval std::array<vitrine_pose_point, n> symmetric_pose(const std::array<vitrine_feature, n>& features,
                                                           const vitrine_pose_point (&half)[m]) {
  std::array<vitrine_pose_point, n> pose{};
  for (std::size_t i = 0; i < n; ++i) {
    bool found = false;
    for (const vitrine_pose_point& point : half) {
      const bool itself = same(point.feature, features[i].name);
      if (itself || (!found && same(point.feature, features[i].mirror))) {
        pose[i] = {features[i].name, itself ? point.u : 1 - point.u, point.v, point.radius};
        found = true;
      }
    }
    if (!found) throw "symmetric_pose: a feature has no point in the half, and its mirror has none either";
  }
  return pose;
}

}  // namespace vitrine::sdk

/// Defines the plugin's one exported symbol. Use once, at file scope, with designated initialisers:
///   VITRINE_PLUGIN(.vendor = "Example", .id = "org.example.poncho", .version = "1.0.0",
///                  .garments = vitrine::sdk::span(garments), .necklines = {}, .extension = nullptr);
/// constinit: a table that would need code at load time does not compile.
#define VITRINE_PLUGIN(...)                                                                                          \
  extern "C" {                                                                                                       \
  constinit const vitrine_plugin vitrine_plugin_entry = {.magic = VITRINE_MAGIC,                                     \
                                                         .abi_major = VITRINE_ABI_MAJOR,                             \
                                                         .abi_minor = VITRINE_ABI_TARGET_MINOR,                      \
                                                         .size = static_cast<std::uint32_t>(sizeof(vitrine_plugin)), \
                                                         __VA_ARGS__};                                               \
  }                                                                                                                  \
  static_assert(true)
