// SPDX-License-Identifier: MIT
#include "vitrine/check.hpp"
#include "vitrine/templates/sleeve.hpp"

namespace {

constexpr auto garments = std::array{vitrine::templates::long_sleeve};
static_assert(vitrine::sdk::check(garments[0]));

}  // namespace

VITRINE_PLUGIN(.vendor = "Vitrine", .id = "org.vitrine.long_sleeve", .version = "0.1.0",
               .garments = vitrine::sdk::span(garments), .necklines = {}, .extension = nullptr);
