// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>

#include "colours.hpp"

namespace vitrine {

/// Foreground of a picture by colour: a mixture that knows where on the board each ground colour lives, a mixture for
/// the garment, and a minimum cut between them, repeated on a small picture (after Rother et al., GrabCut, 2004); the
/// cut is then taken to larger pictures within a band along its contour (after Lombaert et al., A multilevel banded
/// graph cuts method, 2005).
class ColourCut {
 public:
  /// The cut of a picture of 128 to 256 px. CV_8U, 0 or 255; all 0 when nothing differs from the ground. `known` is the
  /// garment as far as another method found it, of any size; when empty, the picture's border says what the ground is.
  cv::Mat start(const cv::Mat& rgb, const cv::Mat& known);
  /// The cut `mask` of the picture before, on a larger one, given in Lab. Only pixels within `reach` [px of the larger
  /// picture] of its contour may change sides. `ground_like` receives the pixels whose colour speaks clearly for the
  /// ground.
  cv::Mat sharpen(const cv::Mat& lab, const cv::Mat& mask, int reach, cv::Mat& ground_like) const;

 private:
  Ground ground_;
  Cloth cloth_;
};

}  // namespace vitrine
