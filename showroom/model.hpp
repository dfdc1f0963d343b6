// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vitrine/model/image.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine::showroom {

struct VerticalExtent {
  double low = 0, high = 0;  ///< [m]
};
/// From the accessors' minima and maxima, without reading a vertex. Empty when the file is no GLB.
std::optional<VerticalExtent> vertical_extent(const std::filesystem::path& glb);

/// Families of the colours that the garment's triangles show of its texture, the commonest first: black, grey, white,
/// beige, brown, red, orange, yellow, green, blue, purple or pink. One, or two when the second covers a quarter or
/// more. Error (65): NOT_A_GLB.
Result<std::vector<std::string>> colour_families(const std::filesystem::path& glb);

/// The family of an sRGB colour, by lightness, chroma and hue in CIE LCh(ab), D65.
const char* colour_family(std::uint8_t red, std::uint8_t green, std::uint8_t blue);

}  // namespace vitrine::showroom
