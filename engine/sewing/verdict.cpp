// SPDX-License-Identifier: GPL-3.0-or-later
#include "verdict.hpp"

#include "text.hpp"

namespace vitrine::sewing {
namespace {

constexpr double strain_bar = 0.8;  // [-] jersey and rib bear nearly double their width; beyond, cloth would tear

}  // namespace

void judge(const Findings& findings, Drape& out) {
  if (findings.fallen) {
    out.status = "NOT_SUPPORTED";
    out.detail = "Nothing holds the garment: it slid off the body and kept falling.";
  } else if (findings.open > 0) {
    out.status = "SEAM_OPEN";
    out.detail =
        text("%.0f sewn pairs did not meet; the widest gap is %.1f mm.", findings.open, 1000 * findings.gap_open);
  } else if (out.penetration_mm_max > 1000 * penetration_bar) {
    out.status = "INSIDE_BODY";
    out.detail = text("The cloth lies up to %.1f mm inside the body.", out.penetration_mm_max);
  } else if (out.stretch_p99 > strain_bar) {
    out.status = "OVERSTRETCHED";
    out.detail = text(
        "One edge in a hundred is stretched by more than %.0f %%: the garment is too small for this body or its fabric "
        "too soft.",
        100 * out.stretch_p99);
  } else if (!(out.residual <= 1.05 * findings.residual_asked)) {
    out.status = "NOT_CONVERGED";
    out.detail =
        text("The forces are balanced to r = %.2g of the weight, not to %.2g.", out.residual, findings.residual_asked);
  } else {
    out.status = "OK";
  }
}

}  // namespace vitrine::sewing
