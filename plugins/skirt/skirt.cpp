// SPDX-License-Identifier: MIT
#include "vitrine/templates/skirt.hpp"

#include "vitrine/check.hpp"

namespace {

constexpr auto garments = std::array{vitrine::templates::skirt};
static_assert(vitrine::sdk::check(garments[0]));

}  // namespace

VITRINE_PLUGIN(.vendor = "Vitrine", .id = "org.vitrine.skirt", .version = "0.1.0",
               .garments = vitrine::sdk::span(garments), .necklines = {}, .extension = nullptr);
