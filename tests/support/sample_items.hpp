// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "photo_maker.hpp"

namespace vitrine::support {

/// One garment of catalog/sample.
struct SampleItem {
  std::string sku, neckline, fabric, title;
  PhotoSpec front;
};

const std::vector<SampleItem>& sample_items();

/// The text of catalog/sample/manifest.csv.
std::string sample_manifest();

/// The JPEG file of a photo.
std::vector<std::uint8_t> to_jpeg(const Image& rgb, int quality = 90);

}  // namespace vitrine::support
