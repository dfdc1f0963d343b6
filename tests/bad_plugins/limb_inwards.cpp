// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

namespace {

constexpr auto inwards = std::array<vitrine_name, 3>{{{"wrist_left"}, {"elbow_left"}, {"shoulder_left"}}};

}  // namespace

BROKEN_GARMENT(Sleeves, t.limbs[0].chain = vitrine::sdk::span(inwards));
