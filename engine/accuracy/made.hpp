// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "vitrine/accuracy.hpp"

namespace vitrine::accuracy {

/// What one run left behind, as far as it is compared.
struct Made {
  std::string status;   ///< of the drape, or the code of the room that refused
  std::string message;  ///< of the refusal
  int nodes = 0;
  double residual = 0, cpu_ms = 0, sewing_ms = 0, peak_mb = 0, seam_gap_mm = 0, penetration_mm = 0;
  std::optional<double> estimate_mm, iou, landmark_mm;
  std::optional<double> hem, waist, chest;  ///< [m] height of the hem, girths
  std::vector<std::string> skipped;
  TriMesh surface;  ///< [m]; empty when a room refused before the cloth came to rest

  bool draped() const { return !surface.triangles.empty(); }
  /// Cloth that slid off has no rest shape to compare with.
  bool comparable() const { return draped() && status != "NOT_SUPPORTED"; }
};

Bytes to_bytes(const Made& made);
/// None when they are not whole.
std::optional<Made> from_bytes(const Bytes& bytes);

/// Runs one item with one of the settings in a forked process. `whole`: with texture, files, picture and the look at
/// the photo; else as far as the cloth at rest.
Made make(const ConvertRequest& request, const Settings& settings, bool whole);

/// SHA-256 [hex].
std::string hash_of(const std::string& text);

}  // namespace vitrine::accuracy
