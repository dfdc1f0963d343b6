// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "vitrine/model/geometry.hpp"
#include "vitrine/photo.hpp"

namespace vitrine::sight {

/// A photo whose garment is known.
struct Case {
  std::string name, garment, neckline, ground;
  bool back = false;
  Photo photo;
  Image truth;                         ///< three labels
  std::map<std::string, Vec2> points;  ///< [px] in the front frame
};

/// The photos of a folder with index.tsv, masks and landmarks; what cannot be read is named on standard error.
std::vector<Case> marked_photos(const std::filesystem::path& folder);

/// A generated photo, its contrast, noise, light falloff and tilt drawn beyond what shops deliver.
Case variant(std::uint32_t seed);

}  // namespace vitrine::sight
