// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "vitrine/model/garment.hpp"

namespace vitrine {

using Colour = Eigen::Vector3f;  ///< linear RGB

float srgb_to_linear(std::uint8_t v);
std::uint8_t linear_to_srgb(double v);

/// A mesh's texture in linear light, reduced so that one texel is not much smaller than what a ray stands for: fine
/// stripes would otherwise turn into moire.
class TextureLookup {
 public:
  /// `footprint` [m]: distance of neighbouring rays on the subject.
  TextureLookup(const RenderMesh& mesh, double footprint);
  /// Bilinear colour; the mesh's plain colour where it has no texture.
  Colour at(double u, double v) const;

 private:
  int width_ = 0, height_ = 0;
  std::vector<Colour> texels_;
  Colour plain_;
};

}  // namespace vitrine
