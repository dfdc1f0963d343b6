// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vitrine/model/garment.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

using Bytes = std::vector<std::uint8_t>;

struct GlbOptions {
  int jpeg_quality = 88;      ///< [-] 1..100
  std::string copyright{};    ///< asset.copyright; empty = none
  std::string extras_json{};  ///< asset.extras as JSON text; empty = none
};

/// Binary glTF 2.0: one node and one mesh per RenderMesh, metres, +Y up, +Z front, doubleSided, 16-bit indices where
/// they fit.
Result<Bytes> encode_glb(std::span<const RenderMesh> meshes, const GlbOptions& options = {});

/// Writes `name`.obj with .mtl and texture into the folder, through assimp.
std::optional<Error> write_obj(std::span<const RenderMesh> meshes, const std::string& folder, const std::string& name);

Result<Bytes> encode_png(const Image& image);
Result<Bytes> encode_jpeg(const Image& image, int quality);

/// Writes to a temporary name in the same folder and renames, so that a reader never sees half a file. Error: cannot
/// write (73).
std::optional<Error> write_file(const std::string& path, std::span<const std::uint8_t> bytes);
std::optional<Error> write_file(const std::string& path, const std::string& text);

}  // namespace vitrine
