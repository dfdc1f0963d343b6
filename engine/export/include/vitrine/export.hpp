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
  int jpeg_quality = 97;    ///< [-] 1..100, of the textures
  int lowest_quality = 80;  ///< [-] 1..jpeg_quality: as far as it is lowered, in steps, to keep the next line
  int quality_step = 2;     ///< [-] at least 1
  std::size_t texture_bytes = 820'000;  ///< [byte] all JPEGs together; above, the quality is lowered
  std::string generator = "Vitrine";    ///< asset.generator
  std::string copyright{};              ///< asset.copyright; empty = none
  std::string extras_json{};            ///< asset.extras as JSON text; empty = none
};

/// A mesh's pictures as they go into a file: JPEGs, empty where the mesh has none.
struct GlbPictures {
  Bytes colour, occlusion;
};

/// All pictures at the highest quality at which together they keep the budget, one entry for each mesh.
/// Errors (64): BAD_QUALITY; (70): BAD_IMAGE.
Result<std::vector<GlbPictures>> encode_pictures(std::span<const RenderMesh> meshes, const GlbOptions& options = {});

/// Binary glTF 2.0: one node, mesh and material per RenderMesh, metres, +Y up, +Z front, doubleSided, 16-bit indices
/// where they fit, triangles and vertices in the order a graphics card's caches like.
Result<Bytes> encode_glb(std::span<const RenderMesh> meshes, const GlbOptions& options = {});
/// The same with pictures that are encoded already, for the first meshes that they were made for: two files of one
/// garment need them once.
Result<Bytes> encode_glb(std::span<const RenderMesh> meshes, std::span<const GlbPictures> pictures,
                         const GlbOptions& options);

/// A copy for a web page: the same file with its vertex and index data under EXT_meshopt_compression; positions are
/// kept to 1/16,384 of the largest coordinate of each vertex, normals and texture coordinates likewise. Viewers need
/// meshoptimizer's decoder for it. Error (65): NOT_A_GLB.
Result<Bytes> compress_glb(std::span<const std::uint8_t> glb);

enum class MeshFormat { obj, ply };

/// Writes the meshes into the folder through assimp: `name`.obj with .mtl and PNG textures for all of them together, or
/// one `name`_MESH.ply each (`name`.ply when there is one), which names its texture in a comment. Error: cannot write
/// (73).
std::optional<Error> write_meshes(std::span<const RenderMesh> meshes, MeshFormat format, const std::string& folder,
                                  const std::string& name);

/// A name that every shop platform takes: [a-z][a-z0-9_-]*, `prefix`_ followed by the text in lower case with - in
/// place of anything else; the prefix alone for an empty text.
std::string portable_name(const std::string& prefix, const std::string& text);

Result<Bytes> encode_png(const Image& image);
Result<Bytes> encode_jpeg(const Image& image, int quality);
/// Lossy; the only format here that is small and has an alpha channel.
Result<Bytes> encode_webp(const Image& image, int quality);

/// Writes to a temporary name in the same folder and renames, so that a reader never sees half a file. Error: cannot
/// write (73).
std::optional<Error> write_file(const std::string& path, std::span<const std::uint8_t> bytes);
std::optional<Error> write_file(const std::string& path, const std::string& text);

}  // namespace vitrine
