// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies to build: a seeded draw from the population, and the corners of what the tool is asked to survive.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vitrine/mannequin.hpp"

namespace vitrine::bench {

/// `count` women and men in turn: means and deviations of ANSUR II (Gordon et al., NATICK/TR-15/007), every
/// measurement, difference and ratio within its 1-99 % range. The same seed gives the same people.
std::vector<Measurements> draw_people(int count, std::uint64_t seed);

/// All 2^8 corners for one sex: of the range that the tool accepts for each measurement alone, or of the wider one that
/// it has to survive.
std::vector<Measurements> corner_people(const char* sex, bool accepted);

/// Front, side and back of women XS, M, XXL and men M, L as one JPEG.
std::optional<Error> draw_sheet(const std::string& path);

}  // namespace vitrine::bench
