// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "cutout.hpp"

namespace vitrine {

/// Evens out two photos lit differently: scales the back's light, channel by channel, by the median ratio of front to
/// back along the outline edges of the same name. The front is never touched, and pattern, print and folds keep their
/// contrast. Does nothing where the colours are not alike: then the garment itself differs. Returns the gain.
std::array<double, 3> match_gain(std::span<const TextureSource> panels, std::vector<Cutout>& cuts);

}  // namespace vitrine
