// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <string>

#include "vitrine/model/image.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

struct PhotoOptions {
  std::uint64_t max_bytes = 256u << 20;   ///< [byte] largest file that is read
  std::uint64_t max_pixels = 80'000'000;  ///< [px] checked against the header before anything is decoded
  int min_side = 64;                      ///< [px] smaller photos are refused (TOO_SMALL)
  int max_side = 2400;                    ///< [px] larger photos are reduced to this after decoding
  bool mirror = false;                    ///< flip left/right into the front frame (back photos)
};

/// A decoded photo: upright by EXIF, RGB, in the front frame (see garment_template.hpp).
struct Photo {
  std::string path;
  Image rgb;    ///< 3 channels
  Image alpha;  ///< 1 channel, same size; empty when the file has none or it is opaque everywhere
  Image mask;   ///< 1 channel of Label values given by the shop; empty when none was given
  int source_width = 0, source_height = 0;  ///< [px] as displayed (after EXIF), before any reduction
  double scale = 1;                         ///< this picture's pixels per source pixel
  bool mirrored = false;
  int quarter_turns = 0;  ///< counter-clockwise quarter turns applied after mirroring, 0 to 3: rgb, alpha and mask
                          ///< stand upright, source_width and source_height do not
};

/// The picture turned counter-clockwise by `quarter_turns` times 90 degrees.
Image turned(const Image& image, int quarter_turns);

/// Turns the photo's pictures, on top of the turns that it already has.
void turn_photo(Photo& photo, int quarter_turns);

/// Reads JPEG, PNG, WebP, TIFF, BMP. The file's header is checked against the limits before pixels are decoded.
/// Errors: missing (66), unusable (65: NOT_AN_IMAGE, TRUNCATED, TOO_LARGE, TOO_SMALL, MASK_SIZE, EMPTY_MASK).
/// `mask_path` may be empty; a mask is 8-bit, of the photo's size: 0 background, 128 inside of the back, 255 garment.
Result<Photo> load_photo(const std::string& path, const std::string& mask_path, const PhotoOptions& options = {});

}  // namespace vitrine
