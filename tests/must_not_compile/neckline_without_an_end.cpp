// SPDX-License-Identifier: GPL-3.0-or-later
// expects: neckline.profile: a profile runs from (0,0) to (1,0) and reaches depth 1
// expects: neck_short
#include "garment.hpp"

constexpr std::array<vitrine_profile_point, 3> profile = {{{0, 0}, {0.5, 1}, {0.9, 0}}};
constexpr vitrine_neckline neckline = {.id = "neck_short",
                                       .title = "Short",
                                       .profile = sdk::span(profile),
                                       .ratio_min = 0.5,
                                       .ratio_max = 2,
                                       .default_depth = 0.5};
VITRINE_CHECK(neckline);
