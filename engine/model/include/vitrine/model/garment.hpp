// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "vitrine/model/geometry.hpp"
#include "vitrine/model/image.hpp"

namespace vitrine {

/// A garment or mannequin ready for a file or a picture. One entry per vertex in each filled array; vertices are split
/// where the texture is cut (at seams), so positions may repeat; normals are continuous over sewn seams.
struct RenderMesh {
  std::string name;             ///< node name in files: "garment", "mannequin"
  std::vector<Vec3> positions;  ///< metres
  std::vector<Vec3> normals;    ///< unit
  std::vector<Vec2> uv;         ///< glTF convention: (0,0) is the top left of the texture; empty = no texture
  std::vector<Triangle> triangles;
  Image texture;    ///< RGB atlas; empty = plain colour
  Image occlusion;  ///< 1 channel, laid out as the texture, of any size: how open the outer face lies, 255 = open
  std::vector<float> shade;  ///< [-] the same per vertex, 0..1, for a mesh without texture; empty = all open
  std::array<double, 3> colour{0.8, 0.8, 0.8};  ///< linear RGB base colour where there is no texture
};

}  // namespace vitrine
