// SPDX-License-Identifier: MIT
#include "vitrine/check.hpp"
#include "vitrine/templates/necklines.hpp"

namespace {

constexpr auto necklines = std::array{vitrine::templates::neck_square};
static_assert(vitrine::sdk::check(necklines[0]));

}  // namespace

VITRINE_PLUGIN(.vendor = "Vitrine", .id = "org.vitrine.neck_square", .version = "0.1.0", .garments = {},
               .necklines = vitrine::sdk::span(necklines), .extension = nullptr);
