// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vitrine/model/result.hpp"

namespace vitrine::feed {

/// A GLB of the output folder and what is told of it.
struct ModelFile {
  std::string path;  ///< below the output folder
  std::string name;  ///< without folder and .glb: garment, dressed, ...
  std::string size;  ///< the mannequin of a size run, or empty
  std::uintmax_t bytes = 0;
  std::string sha256;                   ///< [hex]
  std::array<double, 3> low{}, high{};  ///< [m] box of its vertices, +Y up, +Z front
};

/// What a run left for one item.
struct ItemFolder {
  std::string sku;
  std::vector<ModelFile> models;  ///< in the order of their paths
  std::string poster;             ///< picture below the output folder, or empty
  std::uintmax_t poster_bytes = 0;
};

/// Reads a GLB: its hash, and the box from the accessors' minima and maxima. Error (65, MODEL_FILE) where it is not
/// one.
Result<ModelFile> read_model(const std::filesystem::path& root, const std::string& path);

/// The folders of items below the output folder, in the order of their names, that have a GLB. Links are not followed.
/// `left_out` receives files that are no GLB. Error: missing (66, OUT_DIR).
Result<std::vector<ItemFolder>> scan(const std::string& out_dir, std::vector<Error>& left_out);

}  // namespace vitrine::feed
