// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "cutout.hpp"

namespace vitrine {

/// Evens out two photos lit differently: scales the back's channels by the median ratio of front to back colours along
/// the outline edges of the same name, at most 12 %. Does nothing where the colours are not alike: then the garment
/// itself differs.
void match_gain(std::span<const TextureSource> panels, std::vector<Cutout>& cuts);

}  // namespace vitrine
