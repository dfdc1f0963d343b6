// SPDX-License-Identifier: MIT
#pragma once
// Fabrics of everyday garments: stiffness, bending and weight as they lie in the literature's ranges (Kawabata and FAST
// data sheets; a knit gives an order of magnitude more than a woven), not measurements of one cloth.
#include <array>

#include "vitrine/plugin.hpp"

namespace vitrine::templates {

//                                          name            stretch shear  bend    mass  friction
//                                                          [N/m]   [N/m]  [N m]   [kg/m2]  [-]
inline constexpr vitrine_fabric jersey = {"jersey", 300, 90, 1.0e-5, 0.18, 0.35};
inline constexpr vitrine_fabric rib_knit = {"rib_knit", 150, 55, 1.5e-5, 0.24, 0.40};
inline constexpr vitrine_fabric sweatshirt = {"sweatshirt", 450, 150, 4.0e-5, 0.30, 0.45};
inline constexpr vitrine_fabric cotton_woven = {"cotton_woven", 1200, 240, 2.0e-5, 0.14, 0.40};
inline constexpr vitrine_fabric wool_twill = {"wool_twill", 900, 180, 3.0e-5, 0.26, 0.50};
inline constexpr vitrine_fabric denim = {"denim", 2000, 500, 1.0e-4, 0.40, 0.50};
inline constexpr vitrine_fabric satin = {"satin", 800, 110, 6.0e-6, 0.12, 0.22};

/// The first of each list is the default.
inline constexpr auto vest_fabrics = std::array{jersey, rib_knit, cotton_woven, satin};
inline constexpr auto long_sleeve_fabrics = std::array{jersey, rib_knit, sweatshirt, cotton_woven, satin};
inline constexpr auto skirt_fabrics = std::array{cotton_woven, denim, wool_twill, jersey, satin};

}  // namespace vitrine::templates
