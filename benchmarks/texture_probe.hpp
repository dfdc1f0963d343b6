// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "texture_cases.hpp"

namespace vitrine::bench {

/// A panel's photo beside its flat mesh, textured and seen straight on.
struct Fidelity {
  double psnr = 0;       ///< [dB] over the mask, clear of the rim that is replaced
  double psnr_mask = 0;  ///< [dB] over all of the mask that the panel covers
  double rim_share = 0;  ///< [-] of the mask within the rim
};
/// `atlas` as it was decoded from the file; the rim is what lies within `rim` [px] of the mask's border. `gain`, of
/// linear light, is what the panel's photo was brightened by on purpose: the photo is held to it.
Fidelity measure_fidelity(const TextureSource& source, const std::vector<Vec2>& uv, const Image& atlas, double rim,
                          const std::array<double, 3>& gain);

/// Texels within 3 px of a panel's outline, and how many of them are nearer to a colour of the board than to any of the
/// garment, in CIE Lab; both palettes are taken from the photo, clear of the border.
struct BoardTexels {
  int near = 0, wrong = 0;
  double worst = 0;  ///< [dE] largest lead of the board
};
BoardTexels count_board(const TextureSource& source, const std::vector<Vec2>& uv, const Image& atlas);

/// CIE76 differences across the sewn seams of front and back, between patches of 8 mm beside the seam.
struct SeamSteps {
  std::vector<double> points;  ///< of each pair of nodes: with what print and stripes differ by anyhow
  std::vector<double> seams;   ///< of each seam, between the median colours of its two sides: the light alone
};
SeamSteps seam_steps(const TextureCase& c, const std::vector<std::vector<Vec2>>& uv, const Image& atlas);

double median_of(std::vector<double> values);

}  // namespace vitrine::bench
