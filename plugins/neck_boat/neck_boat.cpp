// SPDX-License-Identifier: MIT
// A boat neck: a wide, shallow arc that follows the collar bones.
#include "vitrine/check.hpp"

namespace {

using namespace vitrine;

/// A parabola, depth = 4 s (1 - s).
constexpr std::array<vitrine_profile_point, 11> profile = {{{0.0, 0.0},
                                                            {0.1, 0.36},
                                                            {0.2, 0.64},
                                                            {0.3, 0.84},
                                                            {0.4, 0.96},
                                                            {0.5, 1.0},
                                                            {0.6, 0.96},
                                                            {0.7, 0.84},
                                                            {0.8, 0.64},
                                                            {0.9, 0.36},
                                                            {1.0, 0.0}}};

// Curved as a U is, and so of the same ratios; what sets it apart is its depth, an eighth of its width and not two
// thirds.
constexpr std::array<vitrine_neckline, 1> necklines = {
    {{"neck_boat", "Boat neck", sdk::span(profile), 0.18, 0.50, 0.13}}};
static_assert(sdk::check(necklines[0]));

}  // namespace

VITRINE_PLUGIN(.vendor = "Vitrine", .id = "org.vitrine.neck_boat", .version = "0.1.0", .garments = {},
               .necklines = vitrine::sdk::span(necklines), .extension = nullptr);
