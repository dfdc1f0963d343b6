// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "photo_maker.hpp"
#include "vitrine/host/registry.hpp"
#include "vitrine/pipeline.hpp"

namespace vitrine::bench {

/// What is done to a sample item's photos before they are converted.
enum class Variant { plain, loud_board, darker_back };

/// An item of the sample catalogue whose photos were made anew, saved as JPEG in `folder` and seen, cut and meshed by
/// the pipeline as any shop's.
struct TextureCase {
  std::string name;
  ConvertRequest request;
  Conversion item;
  support::PhotoSpec front;
};

/// One per sample item; `item.error` says where a photo was refused.
std::vector<TextureCase> make_cases(Variant variant, const std::string& folder, const PluginRegistry& registry,
                                    const std::shared_ptr<const Body>& body);

/// The sources that the texture room gets for an item.
std::vector<TextureSource> sources_of(const TextureCase& c);

}  // namespace vitrine::bench
