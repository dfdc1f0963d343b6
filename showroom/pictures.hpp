// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>

#include "vitrine/model/result.hpp"

namespace vitrine::showroom {

/// card.webp (300 x 400 px) or poster.webp (600 x 800 px) of the front view that a preview.png begins with. Error (65):
/// NOT_A_PICTURE.
std::optional<Error> write_poster(const std::filesystem::path& preview, const std::filesystem::path& out, int width,
                                  int quality);

/// The shop's photo upright and at most 1,200 px large, without what the camera wrote beside the pixels (time, place).
/// Errors: as load_photo().
std::optional<Error> write_photo(const std::filesystem::path& photo, const std::filesystem::path& out);

}  // namespace vitrine::showroom
