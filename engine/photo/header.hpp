// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace vitrine {

/// What a picture file says about itself before anything is decoded.
struct PhotoHeader {
  enum class Kind { unknown, jpeg, png, webp, bmp, tiff };
  Kind kind = Kind::unknown;
  std::uint64_t width = 0, height = 0;  ///< [px] as stored, before EXIF
  int orientation = 1;                  ///< EXIF 1..8
  bool truncated = false;               ///< the file ends before its own end mark or declared size
  bool valid = false;                   ///< sizes were found
};

PhotoHeader read_header(std::span<const std::uint8_t> file);

}  // namespace vitrine
