// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "matching.hpp"
#include "outline.hpp"

namespace vitrine::features_detail {

constexpr double kMinScore = 0.30;  ///< below: another garment

/// A garment's template on an outline, with the outline it needed: sleeves cut free, hanger clips closed.
struct Fit {
  cv::Mat mask;
  Outline outline;
  Match match;
  double score = 0;            ///< [-] 0..1
  bool hidden_sleeve = false;  ///< the outline has the notch of a cuff on the body
  bool legs_together = false;  ///< a garment with legs shows no ground between them
  int guessed = -1;            ///< feature that was put where a body has it, because the photo hides it
  std::vector<std::string> warnings;
};

/// Largest piece of the mask without threads.
cv::Mat whole_piece(const cv::Mat& mask);

/// Fits a garment to a piece made by whole_piece.
Fit fit_garment(const cv::Mat& piece, const GarmentTemplate& garment, const FeatureOptions& options);

}  // namespace vitrine::features_detail
