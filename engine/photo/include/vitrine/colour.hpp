// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <cstdint>

namespace vitrine {

/// CIE L*a*b* (D65, L 0..100) of `count` sRGB colours; both hold three numbers a colour. Good to 0.01 in each number,
/// read off tables that take a millisecond to fill: image libraries spend a fifth of a second on theirs, once in every
/// process, which is more than seeing a photo takes.
void lab_from_srgb(const std::uint8_t* rgb, float* lab, std::size_t count);

}  // namespace vitrine
