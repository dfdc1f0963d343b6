// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "vitrine/sewing.hpp"

namespace vitrine::sewing {

constexpr double penetration_bar = 0.0005;  // [m]

/// What decides the status besides the figures that are in the report anyway.
struct Findings {
  bool fallen = false;        ///< the garment slid off the body and kept falling
  int open = 0;               ///< sewn pairs that did not meet
  double gap_open = 0;        ///< [m] the widest of them
  double residual_asked = 0;  ///< [-]
};

/// The gravest finding names the status, and a sentence of detail says more where it is not OK.
void judge(const Findings& findings, Drape& out);

}  // namespace vitrine::sewing
